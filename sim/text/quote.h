// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What somebody sent, made fit for a sentence: messages end up in logs, on terminals and in JSON,
// where raw bytes would do harm. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace scipd::sim {

/// Printable ASCII stays, every other byte becomes a question mark; what is longer than `limit`
/// ends in dots.
std::string printable(std::string_view text, std::size_t limit = 160);

/// The same between single quotes, short unless told otherwise.
std::string quote(std::string_view text, std::size_t limit = 40);

/// A limit that cuts no path and no address short.
inline constexpr std::size_t whole_path = 4096;

/// Lines and all that people write stay; bytes that are no UTF-8, and characters that would move
/// the cursor, colour what follows or change the order in which it is read, become \xNN. For what
/// goes to a log or a terminal, whoever has written it.
std::string shown(std::string_view text);

/// How many bytes of the text, which are so many at most, are whole characters.
std::size_t whole_characters(std::string_view text, std::size_t most);

}  // namespace scipd::sim
