// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/http/url.h"

#include <algorithm>
#include <charconv>

namespace scipd::daemon {

std::optional<std::string> percent_decoded(std::string_view text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded.push_back(text[i]);
            continue;
        }
        const std::string_view digits = text.substr(i + 1, 2);
        unsigned byte = 0;
        const char* const end = digits.data() + digits.size();
        const auto [stop, error] = std::from_chars(digits.data(), end, byte, 16);
        if (digits.size() != 2 || error != std::errc{} || stop != end) return std::nullopt;
        decoded.push_back(static_cast<char>(byte));
        i += 2;
    }
    return decoded;
}

std::optional<std::string> query_value(std::string_view query, std::string_view key) {
    while (!query.empty()) {
        const std::string_view pair = query.substr(0, query.find('&'));
        query.remove_prefix(std::min(pair.size() + 1, query.size()));
        const auto sign = pair.find('=');
        if (sign != pair.npos && pair.substr(0, sign) == key) {
            return percent_decoded(pair.substr(sign + 1));
        }
    }
    return std::nullopt;
}

}  // namespace scipd::daemon
