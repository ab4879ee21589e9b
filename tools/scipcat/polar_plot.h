// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The view on paper: rings with their distances, the area that the scanner saw free, walls and
// points. Points have the colour of their intensity if it was requested. The scanner is at the
// origin, and forward is up.
#pragma once

#include <cairo.h>

#include "tools/scipcat/plot_text.h"
#include "tools/scipcat/top_view.h"

namespace scipd::tools {

/// Fills a whole Page.
void draw_polar_plot(cairo_t* context, const TopView& view, const PlotText& text);

}  // namespace scipd::tools
