// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/client/scan_request.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "protocol/command_table.h"

namespace scipd::protocol::client {
namespace {

void append_digits(std::string& text, int value, std::size_t width) {
    const std::string digits = std::to_string(value);
    assert(value >= 0 && digits.size() <= width);
    text.append(width - digits.size(), '0').append(digits);
}

DataFormat format_of(const ScanRequest& request) {
    return {.width = request.width,
            .intensity = request.intensity,
            .echoes = request.echoes,
            .io_lines = request.io_lines,
            .stamp = request.microseconds ? Stamp::microseconds : Stamp::milliseconds};
}

/// The code of the command for this kind of data, and the window.
std::string window_line(Parameters parameters, const ScanRequest& request) {
    const auto commands = command_table();
    const auto command = std::ranges::find_if(commands, [&](const Command& candidate) {
        return candidate.parameters == parameters && candidate.format == format_of(request);
    });
    if (command == commands.end())
        throw std::invalid_argument("no command of SCIP asks for this kind of scan");
    std::string line(command->code);
    append_digits(line, request.first_step, 4);
    append_digits(line, request.last_step, 4);
    append_digits(line, request.cluster, 2);
    return line;
}

/// The scan command at the start of this line; null if there is none.
const Command* command_of(std::string_view line) {
    for (const Command& command : command_table()) {
        if ((command.brings_one_scan() || command.brings_scans()) &&
            line.starts_with(command.code) &&
            line.size() == command.code.size() + width(command.parameters))
            return &command;
    }
    return nullptr;
}

}  // namespace

std::size_t ScanRequest::groups() const {
    const int steps = last_step - first_step + 1;
    return static_cast<std::size_t>((steps + cluster - 1) / cluster);
}

std::string single_scan_line(const ScanRequest& request) {
    return window_line(Parameters::window, request);
}

std::string stream_line(const ScanRequest& request) {
    std::string line = window_line(Parameters::scans, request);
    append_digits(line, request.interval, 1);
    append_digits(line, request.scans, 2);
    return line;
}

std::optional<ScanRequest> parse_scan_echo(std::string_view echo) {
    const std::string_view line = echo.substr(0, echo.find(';'));
    const Command* const command = command_of(line);
    if (command == nullptr) return std::nullopt;

    const std::string_view digits = line.substr(command->code.size());
    const bool stream = command->brings_scans();
    const auto first = parse_digits(digits.substr(0, 4));
    const auto last = parse_digits(digits.substr(4, 4));
    const auto contents = parse_contents(digits.substr(8, 2));
    const auto cluster = contents ? 1 : parse_digits(digits.substr(8, 2));
    const auto interval = stream ? parse_digits(digits.substr(10, 1)) : 0;
    const auto scans = stream ? parse_digits(digits.substr(11, 2)) : 0;
    if (!first || !last || !cluster || !interval || !scans || *last < *first) return std::nullopt;
    const DataFormat& format = command->format;
    return ScanRequest{
        .first_step = *first,
        .last_step = *last,
        .cluster = std::max(*cluster, 1),
        .width = format.width,
        .intensity = format.intensity,
        .echoes = format.echoes,
        .io_lines = format.io_lines,
        .microseconds = format.stamp == Stamp::microseconds,
        .interval = *interval,
        .scans = *scans,
        .contents = contents.value_or(Contents::distances),
    };
}

}  // namespace scipd::protocol::client
