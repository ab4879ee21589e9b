// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The marks of a plot, and the legend of its colours and marks: a scale above the plot, or names
// below it. One thread.
#pragma once

#include "tools/scipcat/point_colours.h"
#include "tools/scipcat/sheet.h"

namespace scipd::tools {

/// Draws a point: filled if it is the first echo of its beam, hollow if it is the second, a cross
/// if it is the third. `scale`: how much larger than usual.
void draw_mark(const Sheet& sheet, Spot spot, const PointStyle& style, int echo,
               double scale = 1.0);

/// What the names below the plot take, in the page's units.
[[nodiscard]] double height_of_names(const TopView& view, const Legend& legend);

void draw_legend(const Sheet& sheet, const TopView& view, const Legend& legend);

}  // namespace scipd::tools
