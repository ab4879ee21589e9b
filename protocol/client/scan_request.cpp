// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/client/scan_request.h"

#include <cassert>

#include "protocol/step_window.h"

namespace scipd::protocol::client {
namespace {

constexpr std::size_t single_scan_length = 12;
constexpr std::size_t stream_length = 15;

void append_digits(std::string& text, int value, std::size_t width) {
    const std::string digits = std::to_string(value);
    assert(value >= 0 && digits.size() <= width);
    text.append(width - digits.size(), '0').append(digits);
}

std::string window_line(char family, const ScanRequest& request) {
    assert(request.width == 3 || !(request.intensity || request.echoes));
    std::string line{family, request.width == 2 ? 'S' : request.intensity ? 'E' : 'D'};
    append_digits(line, request.first_step, 4);
    append_digits(line, request.last_step, 4);
    append_digits(line, request.cluster, 2);
    return line;
}

bool known(std::string_view code, bool stream) {
    const bool echoes = code[0] == (stream ? 'N' : 'H');
    const bool one_echo = code[0] == (stream ? 'M' : 'G');
    const bool short_values = code[1] == 'S' && one_echo;
    return (echoes || one_echo) && (code[1] == 'D' || code[1] == 'E' || short_values);
}

}  // namespace

std::size_t ScanRequest::groups() const {
    const int steps = last_step - first_step + 1;
    return static_cast<std::size_t>((steps + cluster - 1) / cluster);
}

std::string single_scan_line(const ScanRequest& request) {
    return window_line(request.echoes ? 'H' : 'G', request);
}

std::string stream_line(const ScanRequest& request) {
    std::string line = window_line(request.echoes ? 'N' : 'M', request);
    append_digits(line, request.interval, 1);
    append_digits(line, request.scans, 2);
    return line;
}

std::optional<ScanRequest> parse_scan_echo(std::string_view echo) {
    const std::string_view line = echo.substr(0, echo.find(';'));
    const bool stream = line.size() == stream_length;
    if (!stream && line.size() != single_scan_length) return std::nullopt;
    if (!known(line.substr(0, 2), stream)) return std::nullopt;

    const auto first = parse_digits(line.substr(2, 4));
    const auto last = parse_digits(line.substr(6, 4));
    const auto cluster = parse_digits(line.substr(10, 2));
    const auto interval = stream ? parse_digits(line.substr(12, 1)) : 0;
    const auto scans = stream ? parse_digits(line.substr(13, 2)) : 0;
    if (!first || !last || !cluster || !interval || !scans || *last < *first) return std::nullopt;
    return ScanRequest{
        .first_step = *first,
        .last_step = *last,
        .cluster = *cluster == 0 ? 1 : *cluster,
        .width = line[1] == 'S' ? 2 : 3,
        .intensity = line[1] == 'E',
        .echoes = line[0] == 'H' || line[0] == 'N',
        .interval = *interval,
        .scans = *scans,
    };
}

}  // namespace scipd::protocol::client
