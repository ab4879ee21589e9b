// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes in a URL: those that RFC 3986 allows are decoded as it says, and others are refused.
// Bytes that were encoded decode to the same bytes, in a path and in a query.
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "daemon/http/url.h"

namespace {

using namespace scipd::daemon;

void require(bool holds) {
    if (!holds) std::abort();
}

std::string encoded(std::string_view bytes) {
    constexpr std::string_view digits = "0123456789abcdefABCDEF";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const auto byte = static_cast<unsigned char>(bytes[i]);
        const auto digit = [&](unsigned value) {
            return i % 2 == 0 || value < 10U ? digits[value] : digits[value + 6U];
        };
        if (std::isalnum(byte) != 0)
            text += bytes[i];
        else
            text.append({'%', digit(byte / 16U), digit(byte % 16U)});
    }
    return text;
}

/// Two digits follow every %, and this checks nothing else.
bool well_written(std::string_view text) {
    const auto is_digit = [](char c) { return std::isxdigit(static_cast<unsigned char>(c)) != 0; };
    for (std::size_t at = text.find('%'); at != text.npos; at = text.find('%', at + 3)) {
        if (at + 2 >= text.size() || !is_digit(text[at + 1]) || !is_digit(text[at + 2]))
            return false;
    }
    return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text{reinterpret_cast<const char*>(data), size};
    const auto decoded = percent_decoded(text);
    require(decoded.has_value() == well_written(text));
    if (decoded) {
        const auto escapes = static_cast<std::size_t>(std::count(text.begin(), text.end(), '%'));
        require(decoded->size() == text.size() - 2 * escapes);
    }

    require(percent_decoded(encoded(text)) == text);
    const auto left = text.substr(0, size / 2);
    const auto right = text.substr(size / 2);
    const std::string query = "left=" + encoded(left) + "&&x&right=" + encoded(right) + "&right=2";
    require(query_value(query, "left") == left);
    require(query_value(query, "right") == right);
    require(!query_value(query, "lef"));

    if (const auto value = query_value(text, "scan")) require(text.find("scan=") != text.npos);
    return 0;
}
