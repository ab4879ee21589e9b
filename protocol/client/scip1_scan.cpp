// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/client/scip1_scan.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

#include "protocol/char_code.h"
#include "protocol/scip1.h"

namespace scipd::protocol::client {
namespace {

constexpr std::size_t value_width = 2;

/// Takes so many digits off the front; negative where they are none.
int take_number(std::string_view& digits, std::size_t count) {
    int number = -1;
    const char* const end = digits.data() + count;
    const auto [stop, error] = std::from_chars(digits.data(), end, number);
    digits.remove_prefix(count);
    return stop == end ? number : -1;
}

std::optional<ScanRequest> request_in(std::string_view echo) {
    constexpr std::size_t length = 9;
    if (echo.size() != length || !echo.starts_with('G')) return std::nullopt;
    echo.remove_prefix(1);
    ScanRequest request{.width = value_width};
    request.first_step = take_number(echo, 3);
    request.last_step = take_number(echo, 3);
    request.cluster = std::max(take_number(echo, 2), 1);
    if (request.first_step < 0 || request.last_step < request.first_step) return std::nullopt;
    return request;
}

}  // namespace

std::optional<ScanMessage> parse_scip1_scan(const Message& message) {
    if (message.damage || message.status != std::string{scip1_status::ok}) return std::nullopt;
    const auto request = request_in(message.echo);
    if (!request) return std::nullopt;
    std::string data;
    for (const std::string& line : message.lines)
        data += line;
    if (data.size() != request->groups() * value_width) return std::nullopt;
    ScanMessage scan{.request = *request, .status = message.status};
    for (std::size_t i = 0; i < data.size(); i += value_width) {
        const auto value = decode(std::string_view(data).substr(i, value_width));
        if (!value) return std::nullopt;
        scan.distances_mm.push_back(static_cast<std::uint32_t>(*value));
    }
    return scan;
}

}  // namespace scipd::protocol::client
