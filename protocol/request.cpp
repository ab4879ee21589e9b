// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/request.h"

#include <algorithm>
#include <utility>

#include "protocol/command_table.h"

namespace scipd::protocol {
namespace {

constexpr std::size_t max_string_length = 16;

// The specification (SCIP 2.0, C-42-03320B) allows letters, digits, blank and . _ + @. It says
// nothing of an empty string, which is allowed here.
bool legal_in_string(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view(" ._+@").find(c) != std::string_view::npos;
}

std::optional<Status> fault_of_string(std::string_view string) {
    if (string.size() > max_string_length) return status::string_too_long;
    if (!std::all_of(string.begin(), string.end(), legal_in_string)) return status::string_illegal;
    return std::nullopt;
}

}  // namespace

Request parse_request(Line line, const DeviceProfile& profile) {
    Request request{.echo = std::move(line.text)};
    const std::string_view text = request.echo;
    const std::size_t semicolon = std::min(text.find(';'), text.size());

    request.command = find_command(text.substr(0, semicolon), profile);
    if (request.command != nullptr)
        request.parameters_length = semicolon - request.command->code.size();
    if (line.overlong) {
        request.fault = status::too_long;
    } else if (semicolon < text.size()) {
        request.fault = fault_of_string(text.substr(semicolon + 1));
    }
    return request;
}

}  // namespace scipd::protocol
