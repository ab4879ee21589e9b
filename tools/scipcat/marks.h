// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include "tools/scipcat/point_colours.h"
#include "tools/scipcat/sheet.h"

namespace scipd::tools {

/// Draws a point: filled if it is the first echo of its beam, hollow if it is the second, a cross
/// if it is the third. `scale`: how much larger than usual.
void draw_mark(const Sheet& sheet, Spot spot, const PointStyle& style, int echo,
               double scale = 1.0);

}  // namespace scipd::tools
