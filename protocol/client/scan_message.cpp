// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/client/scan_message.h"

#include <optional>
#include <span>
#include <string_view>

#include "protocol/char_code.h"
#include "protocol/client/status_text.h"
#include "protocol/data_block.h"
#include "protocol/status.h"
#include "protocol/timestamp.h"

namespace scipd::protocol::client {
namespace {

constexpr char echo_mark = '&';

using Lines = std::span<const std::string>;

/// Joins the data lines; nothing if a line before the last is not full.
std::optional<std::string> join(Lines lines) {
    std::string data;
    for (const std::string& line : lines) {
        const bool last = &line == &lines.back();
        if (line.size() > data_line_length || (!last && line.size() < data_line_length))
            return std::nullopt;
        data += line;
    }
    return data;
}

/// Takes the line of inputs and outputs off the front.
bool take_io(Lines& lines, ScanMessage& scan) {
    constexpr std::size_t width = 3;
    if (lines.empty() || lines.front().size() != 2 * width) return false;
    const std::string_view words = lines.front();
    const auto inputs = decode(words.substr(0, width));
    const auto outputs = decode(words.substr(width));
    if (!inputs || !outputs) return false;
    scan.inputs = static_cast<std::uint32_t>(*inputs);
    scan.outputs = static_cast<std::uint32_t>(*outputs);
    lines = lines.subspan(1);
    return true;
}

bool take_stamp(Lines& lines, ScanMessage& scan) {
    const bool microseconds = scan.request.microseconds;
    const std::size_t width = microseconds ? microsecond_stamp_width : timestamp_width;
    const auto stamp = lines.front().size() == width ? decode(lines.front()) : std::nullopt;
    if (!stamp) return false;
    if (microseconds) {
        scan.stamp_us = *stamp;
    } else {
        scan.stamp_ms = static_cast<std::uint32_t>(*stamp);
    }
    lines = lines.subspan(1);
    return true;
}

/// Takes the echoes off the front of the data, step by step.
class EchoReader {
  public:
    EchoReader(std::string_view data, const ScanRequest& request)
        : data_(data), request_(request), width_(static_cast<std::size_t>(request.width)) {}

    [[nodiscard]] bool at_end() const { return data_.empty(); }
    [[nodiscard]] std::optional<Echo> first() {
        const auto distance = value();
        const auto intensity = request_.intensity ? value() : 0;
        if (!distance || !intensity) return std::nullopt;
        return Echo{*distance, *intensity};
    }
    /// Call first() before. '&' is below '0', so no value can begin with it.
    [[nodiscard]] bool has_further() const {
        return request_.echoes && data_.starts_with(echo_mark);
    }
    [[nodiscard]] std::optional<Echo> further() {
        data_.remove_prefix(1);
        return first();
    }

  private:
    std::optional<std::uint32_t> value() {
        if (data_.size() < width_) return std::nullopt;
        const auto number = decode(data_.substr(0, width_));
        data_.remove_prefix(width_);
        return number ? std::optional(static_cast<std::uint32_t>(*number)) : std::nullopt;
    }

    std::string_view data_;
    const ScanRequest& request_;
    std::size_t width_;
};

/// False if the data ends within a value or has invalid characters.
bool read_echoes(std::string_view data, ScanMessage& scan) {
    EchoReader reader(data, scan.request);
    while (!reader.at_end()) {
        const auto nearest = reader.first();
        if (!nearest) return false;
        scan.distances_mm.push_back(nearest->distance_mm);
        if (scan.request.intensity) scan.intensities.push_back(nearest->intensity);
        if (scan.request.echoes) scan.further_echoes.emplace_back();
        while (reader.has_further()) {
            const auto echo = reader.further();
            if (!echo) return false;
            scan.further_echoes.back().push_back(*echo);
        }
    }
    return true;
}

}  // namespace

std::variant<ScanMessage, std::string> parse_scan(const Message& message) {
    if (message.damage) return describe(*message.damage);
    const auto request = parse_scan_echo(message.echo);
    if (!request) return "\"" + message.echo + "\" is no scan";
    if (message.status != status::ok.text() && message.status != status::scan_follows.text())
        return describe_status(message);

    ScanMessage scan{.request = *request, .status = message.status};
    Lines lines = message.lines;
    if (request->io_lines && !take_io(lines, scan)) return "its inputs and outputs are missing";
    if (lines.empty()) return "it has no time stamp";
    if (!take_stamp(lines, scan)) return "its time stamp is none";
    const auto data = join(lines);
    if (!data) return "its data is not cut into lines of 64 characters";
    if (!read_echoes(*data, scan)) return "its data ends within a value or holds what is none";
    if (scan.distances_mm.size() != request->groups()) {
        return "it has " + std::to_string(scan.distances_mm.size()) + " values instead of " +
               std::to_string(request->groups());
    }
    return scan;
}

}  // namespace scipd::protocol::client
