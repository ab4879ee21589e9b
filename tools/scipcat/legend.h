// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the colours and marks of a plot mean: a scale above it, or names below it. One thread.
#pragma once

#include "tools/scipcat/point_colours.h"
#include "tools/scipcat/sheet.h"

namespace scipd::tools {

/// What the names below the plot take, in the page's units.
[[nodiscard]] double height_of_names(const TopView& view, const Legend& legend);

void draw_legend(const Sheet& sheet, const TopView& view, const Legend& legend);

}  // namespace scipd::tools
