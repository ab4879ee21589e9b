// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The view on paper: rings with their distances, what the scanner saw free, walls and points,
// coloured by intensity where it was asked for. The scanner is at the origin, forward is up.
#pragma once

#include <cairo.h>

#include "tools/scipcat/plot_text.h"
#include "tools/scipcat/top_view.h"

namespace scipd::tools {

/// Fills a Page.
void draw_polar_plot(cairo_t* context, const TopView& view, const PlotText& text);

}  // namespace scipd::tools
