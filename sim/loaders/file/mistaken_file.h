// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What people keep in the place of the file itself: a pointer to it, or the page that shows it.
// Any thread; nothing shared.
#pragma once

#include <string>
#include <string_view>

namespace scipd::sim {

/// Without blanks and a byte order mark at its start.
std::string_view without_blank_start(std::string_view text);

/// Of the beginning of a file: "is a pointer of Git LFS, no mesh; fetch ...", where a "mesh" is
/// wanted. Empty where it is nothing of the kind.
std::string why_mistaken(std::string_view text, const std::string& wanted);

}  // namespace scipd::sim
