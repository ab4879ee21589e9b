// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Common parts of reports: the head of an HTML page that is one file, light or dark as its reader
// has it, and the ticks of an axis. Any thread; nothing shared.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scipd::tools {

/// From the begin of the page to that of its body. `style`: rules that this page has besides. The
/// colours are --ink, --paper, --faint, --rule; --a and --b of two things that stand side by side;
/// --nearer, --farther and --otherwise of what stands out.
[[nodiscard]] std::string html_head(const std::string& title, std::string_view style);

/// The multiples of 1, 2 or 5 times a power of ten from `low` to `high`; at most `most` intervals.
[[nodiscard]] std::vector<double> round_ticks(double low, double high, int most);

}  // namespace scipd::tools
