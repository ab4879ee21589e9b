// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Text that came from outside is worked off some lines at a time, so that whoever sends much of it
// holds nobody up. Any thread; nothing shared.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace scipd::daemon {

/// Hands on as many lines, without their ends, as one turn of the event loop affords. Answers with
/// how many bytes they are, line ends included: 0 where the text is empty only.
template <class Take>
std::size_t take_some_lines(std::string_view text, Take take) {
    // A tenth of a millisecond or two: a hundred senders may do so at once.
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
