// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The small part of RFC 3986 that requests need. Any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace scipd::daemon {

/// Makes "rescue robot" of "rescue%20robot". Nothing where a % is not followed by two hexadecimal
/// digits.
std::optional<std::string> percent_decoded(std::string_view text);

/// The decoded value of `key` in "scan=12&x=1". Nothing where the key is missing or its value
/// cannot be decoded.
std::optional<std::string> query_value(std::string_view query, std::string_view key);

}  // namespace scipd::daemon
