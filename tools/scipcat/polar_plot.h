// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The view on paper: rings with their distances, the area that the scanner saw free, walls and
// points, and what their colours mean. The scanner is at the origin, and forward is up.
#pragma once

#include "tools/page.h"
#include "tools/scipcat/plot_text.h"
#include "tools/scipcat/point_colours.h"
#include "tools/scipcat/top_view.h"

namespace scipd::tools {

/// The height of the page that it fills.
[[nodiscard]] double height_of_polar_plot(const TopView& view, const Colouring& colouring);

void draw_polar_plot(Page& page, const TopView& view, const Colouring& colouring,
                     const PlotText& text);

}  // namespace scipd::tools
