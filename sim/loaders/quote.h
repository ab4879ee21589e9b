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

/// The same, short and between single quotes.
std::string quote(std::string_view text);

}  // namespace scipd::sim
