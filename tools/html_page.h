// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What pages have in common that a program writes as a report: one file that needs nothing else,
// light or dark as its reader has it. Any thread; nothing shared.
#pragma once

#include <string>
#include <string_view>

namespace scipd::tools {

/// From the begin of the page to that of its body. `style`: rules that this page has besides. The
/// colours are --ink, --paper, --faint, --rule; --a and --b of two things that stand side by side;
/// --nearer, --farther and --otherwise of what stands out.
[[nodiscard]] std::string html_head(const std::string& title, std::string_view style);

}  // namespace scipd::tools
