// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/client/scan_request.h"

#include <cassert>

namespace scipd::protocol::client {
namespace {

constexpr std::size_t single_scan_length = 12;
constexpr std::size_t stream_length = 15;

void append_digits(std::string& text, int value, std::size_t width) {
    const std::string digits = std::to_string(value);
    assert(value >= 0 && digits.size() <= width);
    text.append(width - digits.size(), '0').append(digits);
}

char kind_of_data(const ScanRequest& request) {
    assert(request.width == 3 || !(request.intensity || request.echoes || request.io_lines));
    if (request.width == 2) return 'S';
    if (request.io_lines) return request.intensity ? 'G' : 'F';
    return request.intensity ? 'E' : 'D';
}

std::string window_line(char family, const ScanRequest& request) {
    std::string line{family, kind_of_data(request)};
    append_digits(line, request.first_step, 4);
    append_digits(line, request.last_step, 4);
    append_digits(line, request.cluster, 2);
    return line;
}

bool known(std::string_view code, bool stream, bool microseconds) {
    const std::string_view with_echoes = "DE";
    const std::string_view with_one_echo = microseconds ? "DE" : "DESFG";
    if (code[0] == (stream ? 'M' : 'G') && (stream || !microseconds))
        return with_one_echo.find(code[1]) != std::string_view::npos;
    if (code[0] == (stream ? 'N' : 'H') && !microseconds)
        return with_echoes.find(code[1]) != std::string_view::npos;
    return false;
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
    std::string line = request.microseconds ? "%" : "";
    line += window_line(request.echoes ? 'N' : 'M', request);
    append_digits(line, request.interval, 1);
    append_digits(line, request.scans, 2);
    return line;
}

std::optional<ScanRequest> parse_scan_echo(std::string_view echo) {
    std::string_view line = echo.substr(0, echo.find(';'));
    const bool microseconds = line.starts_with('%');
    if (microseconds) line.remove_prefix(1);
    const bool stream = line.size() == stream_length;
    if (!stream && line.size() != single_scan_length) return std::nullopt;
    if (!known(line.substr(0, 2), stream, microseconds)) return std::nullopt;

    const auto first = parse_digits(line.substr(2, 4));
    const auto last = parse_digits(line.substr(6, 4));
    const auto contents = parse_contents(line.substr(10, 2));
    const auto cluster = contents ? 1 : parse_digits(line.substr(10, 2));
    const auto interval = stream ? parse_digits(line.substr(12, 1)) : 0;
    const auto scans = stream ? parse_digits(line.substr(13, 2)) : 0;
    if (!first || !last || !cluster || !interval || !scans || *last < *first) return std::nullopt;
    return ScanRequest{
        .first_step = *first,
        .last_step = *last,
        .cluster = *cluster == 0 ? 1 : *cluster,
        .width = line[1] == 'S' ? 2 : 3,
        .intensity = line[1] == 'E' || line[1] == 'G',
        .echoes = line[0] == 'H' || line[0] == 'N',
        .io_lines = line[1] == 'F' || line[1] == 'G',
        .microseconds = microseconds,
        .interval = *interval,
        .scans = *scans,
        .contents = contents.value_or(Contents::distances),
    };
}

}  // namespace scipd::protocol::client
