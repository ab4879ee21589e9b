// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Recognizes what users often have in place of the file itself: a pointer of Git LFS, or the HTML
// page that shows the file. Any thread; nothing shared.
#pragma once

#include <string>
#include <string_view>

namespace scipd::sim {

/// The text without a byte order mark and blanks at its start.
std::string_view without_blank_start(std::string_view text);

/// Looks at the beginning of a file and says what the file really is and what to do: "is a pointer
/// of Git LFS, no mesh; fetch ..." if `wanted` is "mesh". Empty if it is no pointer and no page.
std::string why_mistaken(std::string_view text, const std::string& wanted);

}  // namespace scipd::sim
