// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>

#include "tools/scipcat/plot_text.h"
#include "tools/scipcat/point_colours.h"
#include "tools/scipcat/top_view.h"
#include "tools/terminal.h"

namespace scipd::tools {

/// The view in Braille dots with a scale and a legend below, which fits into the terminal. Second
/// and third echoes are marks. Nothing in it does harm on a terminal.
[[nodiscard]] std::string terminal_plot(const TopView& view, const Colouring& colouring,
                                        const PlotText& text, TerminalSize size);

}  // namespace scipd::tools
