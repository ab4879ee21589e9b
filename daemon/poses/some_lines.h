// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Takes text from outside a few lines at a time, so that a sender of much text holds nobody up. Any
// thread; nothing shared.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace scipd::daemon {

/// Hands as many lines to `take`, without their ends, as one turn of the event loop has time for.
/// Returns how many bytes they had with their ends; that is 0 only where the text is empty.
template <class Take>
std::size_t take_some_lines(std::string_view text, Take take) {
    // This takes a tenth of a millisecond or two, and a hundred senders may do it at once.
    constexpr int most_lines = 16;
    constexpr std::size_t most_bytes = 4096;
    std::size_t taken = 0;
    for (int i = 0; i < most_lines && taken < std::min(text.size(), most_bytes); ++i) {
        const std::size_t end = std::min(text.find('\n', taken), text.size());
        take(text.substr(taken, end - taken));
        taken = std::min(end + 1, text.size());
    }
    return taken;
}

}  // namespace scipd::daemon
