// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Makes text from outside safe for a message. Messages end up in logs, on terminals and in JSON,
// where raw bytes would do harm. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace scipd::sim {

/// Written characters stay, every other byte becomes a question mark. A text of more than `limit`
/// bytes is cut before the character that is too much, and dots follow.
std::string printable(std::string_view text, std::size_t limit = 160);

/// As printable(), between single quotes, with a smaller limit by default.
std::string quote(std::string_view text, std::size_t limit = 40);

/// A limit that cuts no path and no address short.
inline constexpr std::size_t whole_path = 4096;

/// Makes any text safe for a log or a terminal. Line ends, tabs and written characters stay. Bytes
/// that are no UTF-8, and characters that would move the cursor, colour the text after them or
/// change its reading order, become \xNN.
std::string shown(std::string_view text);

/// The words with commas between them.
template <class Words>
std::string listed(const Words& words) {
    std::string text;
    for (const auto& word : words)
        (text += text.empty() ? "" : ", ") += word;
    return text;
}

/// The length of the longest beginning of the text that has at most `most` bytes and cuts no
/// character in two.
std::size_t whole_characters(std::string_view text, std::size_t most);

}  // namespace scipd::sim
