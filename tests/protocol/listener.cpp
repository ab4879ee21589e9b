// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/protocol/listener.h"

#include <algorithm>
#include <array>
#include <variant>

#include "protocol/char_code.h"
#include "protocol/client/decoder.h"
#include "protocol/client/device_info.h"
#include "protocol/client/scan_message.h"
#include "protocol/client/scan_request.h"
#include "protocol/client/status_text.h"
#include "protocol/data_block.h"
#include "protocol/step_window.h"
#include "protocol/timestamp.h"

namespace scipd::protocol {
namespace {

using client::Message;
using client::ScanRequest;

constexpr std::size_t longest_line = 71;  // what urg_library has room for

/// G of SCIP 1.1: start 3, end 3, cluster 2.
std::optional<ScanRequest> parse_scip1_scan(std::string_view echo) {
    if (echo.size() != 9 || !echo.starts_with('G')) return std::nullopt;
    return client::parse_scan_echo("GS0" + std::string(echo.substr(1, 3)) + "0" +
                                   std::string(echo.substr(4)));
}

std::size_t data_length(const ScanRequest& request) {
    const std::size_t values = request.intensity ? 2 : 1;
    const std::size_t each = values * static_cast<std::size_t>(request.width);
    const std::size_t further = request.echoes ? (max_echoes - 1) * (1 + each) : 0;
    return request.groups() * (each + further);
}

template <typename Parsed>
std::string fault_of(const std::variant<Parsed, std::string>& parsed) {
    const auto* const fault = std::get_if<std::string>(&parsed);
    return fault == nullptr ? "" : *fault;
}

std::string version_fault(const Message& message, const DeviceProfile& profile) {
    const auto parsed = client::parse_version(message);
    if (std::string fault = fault_of(parsed); !fault.empty()) return fault;
    const auto& version = std::get<client::Version>(parsed);
    const bool same = version.vendor == profile.vendor && version.product == profile.product &&
                      version.firmware == profile.firmware &&
                      version.protocol == profile.protocol && version.serial == profile.serial;
    return same && message.lines.size() == 5 ? "" : "it is of another product";
}

std::string parameters_fault(const Message& message, const DeviceProfile& profile) {
    const auto parsed = client::parse_parameters(message);
    if (std::string fault = fault_of(parsed); !fault.empty()) return fault;
    const auto& parameters = std::get<client::Parameters>(parsed);
    const bool same = parameters.model == profile.model && parameters.dmin_mm == profile.dmin_mm &&
                      parameters.dmax_mm == profile.dmax_mm && parameters.ares == profile.ares &&
                      parameters.amin == profile.amin && parameters.amax == profile.amax &&
                      parameters.afrt == profile.afrt && parameters.scan_rpm == profile.scan_rpm;
    return same && message.lines.size() == 8 ? "" : "it is of another product";
}

// A device out of order names its model and its trouble only.
std::string state_fault(const Message& message, const DeviceProfile& profile) {
    const auto parsed = client::parse_state(message);
    if (std::string fault = fault_of(parsed); !fault.empty()) return fault;
    const auto& state = std::get<client::SensorState>(parsed);
    if (state.model != profile.model) return "it is of another product";
    if (message.lines.size() == 2) return state.health == profile.health_failed ? "" : "its health";
    if (message.lines.size() != 7) return "it has neither 7 nor 2 lines";
    if (state.laser != "ON" && state.laser != "OFF") return "its laser is \"" + state.laser + "\"";
    return state.time_ms ? "" : "its time cannot be read";
}

std::string one_line_fault(const Message& message, std::size_t width) {
    if (message.lines.size() != 1 || message.lines.front().size() != width)
        return "it is not one line of " + std::to_string(width);
    return decode(message.lines.front()) ? "" : "its line is no number";
}

std::string scip1_fault(const Message& message) {
    if (message.status != "0" && message.status != "E") return "its status is unknown";
    if (message.status == "E" || message.lines.empty())
        return message.lines.empty() ? "" : "a refusal has data";
    if (message.echo == "V") return message.lines.size() == 6 ? "" : "it has not 6 lines";
    const auto request = parse_scip1_scan(message.echo);
    if (!request) return "nothing but V and G has data";
    std::size_t values = 0;
    for (const std::string& line : message.lines) {
        if (line.size() % 2 != 0 || line.size() > data_line_length) return "a line is cut badly";
        for (std::size_t i = 0; i < line.size(); i += 2, ++values) {
            if (!decode(std::string_view(line).substr(i, 2))) return "a value is none";
        }
    }
    return values == request->groups() ? "" : "it has too many or too few values";
}

std::string content_fault(const Message& message, const DeviceProfile& profile) {
    if (message.status.size() == 1) return scip1_fault(message);
    const bool carried_out = message.status == "00" || message.status == "99";
    if (!carried_out) return message.lines.empty() ? "" : "a refusal has data";
    const std::string_view echo = message.echo;
    const std::string_view request = echo.substr(0, echo.find(';'));
    if (request == "VV") return version_fault(message, profile);
    if (request == "PP") return parameters_fault(message, profile);
    if (request == "II") return state_fault(message, profile);
    if (request == "%ST") return one_line_fault(message, 3);
    if (request == "TM1") return one_line_fault(message, timestamp_width);
    if (request == "%TM1") return one_line_fault(message, microsecond_stamp_width);
    const auto scan = client::parse_scan_echo(echo);
    const bool acknowledges = message.status == "00" && (!scan || request.size() > 12);
    if (acknowledges) return message.lines.empty() ? "" : "nobody asked for data";
    return fault_of(client::parse_scan(message));
}

std::string line_fault(const Message& message) {
    for (const std::string& line : message.lines) {
        if (line.size() + 1 > longest_line) return "a line is too long for urg_library";
    }
    return {};
}

}  // namespace

std::size_t longest_message(std::string_view echo) {
    const std::size_t head = echo.size() + 1 + 4 + 1;
    const std::string_view request = echo.substr(0, echo.find(';'));
    if (request == "VV" || request == "PP" || request == "II" || request == "V")
        return head + 8 * (longest_line + 1);
    auto scan = client::parse_scan_echo(echo);
    if (!scan) scan = parse_scip1_scan(echo);
    const std::size_t stamp_and_wires = microsecond_stamp_width + 2 + 6 + 2;
    if (!scan) return head + stamp_and_wires;
    return head + stamp_and_wires + data_block_size(data_length(*scan), 1);
}

void Listener::said(std::string_view bytes) {
    while (const auto line = reader_.next(bytes))
        requests_.push_back(line->text);
}

void Listener::forget() {
    reader_ = LineReader{};
    requests_.clear();
    stream_.reset();
}

std::string Listener::hear(const Sent& sent) {
    if (sent.at < last_) return "it comes before an earlier one";
    last_ = sent.at;
    client::Decoder decoder;
    std::string_view bytes = sent.bytes;
    const auto message = decoder.next(bytes);
    if (!message) return "it has no end";
    if (!bytes.empty()) return "it goes on behind its end";
    if (message->damage) return client::describe(*message->damage);
    if (sent.bytes.size() > longest_message(message->echo)) return "it is longer than it may be";
    if (std::string fault = line_fault(*message); !fault.empty()) return fault;
    if (std::string fault = content_fault(*message, profile_); !fault.empty()) return fault;
    return sent.kind == Send::Kind::scan ? hear_scan(*message) : hear_reply(*message);
}

std::string Listener::hear_reply(const Message& message) {
    if (requests_.empty()) return "it answers nothing";
    if (message.echo != requests_.front())
        return "it does not answer \"" + requests_.front() + "\", which is next";
    requests_.pop_front();
    follow(message);
    return {};
}

// What began or ended this client's stream.
void Listener::follow(const Message& reply) {
    if (reply.status != "00") return;
    const std::string_view echo = reply.echo;
    const std::string_view request = echo.substr(0, echo.find(';'));
    constexpr std::array ends = {"QT", "RS", "RT", "TM0", "%SL"};
    if (std::find(ends.begin(), ends.end(), request) != ends.end()) stream_.reset();
    const auto scan = client::parse_scan_echo(echo);
    if (!scan || request.size() <= 12) return;
    stream_ = Stream{.head = std::string(request.substr(0, request.size() - 2)),
                     .tail = std::string(echo.substr(request.size())),
                     .scans = scan->scans};
}

// Messages in the place of a scan (21, 98, 0M, ...) do not count.
std::string Listener::hear_scan(const Message& message) {
    if (!stream_) return "it has no stream";
    if (message.status == "99") ++stream_->heard;
    const int left = stream_->scans == 0 ? 0 : stream_->scans - stream_->heard;
    if (left < 0) return "its stream is over";
    const std::string digits = {static_cast<char>('0' + left / 10),
                                static_cast<char>('0' + left % 10)};
    if (message.echo != stream_->head + digits + stream_->tail)
        return "its echo is not " + stream_->head + digits + stream_->tail;
    if (stream_->scans != 0 && left == 0) stream_.reset();
    return {};
}

}  // namespace scipd::protocol
