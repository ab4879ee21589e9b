// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/wire/wire_listener.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <utility>

#include "protocol/request.h"
#include "protocol/words.h"

namespace scipd::daemon {
namespace {

/// Printable, and not endless.
std::string shown(std::string_view line) {
    constexpr std::size_t most = 160;
    std::string text;
    for (const char c : line.substr(0, most)) {
        if (c >= ' ' && c <= '~') {
            text += c;
            continue;
        }
        std::array<char, 5> escape{};
        std::snprintf(escape.data(), escape.size(), "\\x%02x", static_cast<unsigned char>(c));
        text += escape.data();
    }
    return line.size() > most ? text + ".." : text;
}

/// Takes the first line of a message.
std::string_view take_line(std::string_view& bytes) {
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
    return line;
}

/// What the second line of a reply says, before its sum.
std::optional<protocol::Status> status_in(std::string_view line) {
    return line.size() == 3 ? protocol::Status::parse(line.substr(0, 2)) : std::nullopt;
}

bool has_scan(const protocol::Request& echo, protocol::Status status) {
    if (echo.command == nullptr) return false;
    return status == protocol::status::scan_follows ||
           (status == protocol::status::ok && echo.command->brings_one_scan());
}

}  // namespace

WireListener::WireListener(Device& device, std::string client, TakeEntry take)
    : device_(device), client_(std::move(client)), take_(std::move(take)) {}

WireEntry WireListener::begin(std::string_view line, std::size_t bytes) const {
    const Clock& clock = device_.clock();
    return {.client = client_,
            .told = clock.origin() + clock.now(),
            .line = shown(line),
            .bytes = bytes};
}

void WireListener::heard(std::string_view bytes) {
    while (auto line = reader_.next(bytes)) {
        WireEntry entry = begin(line->text, line->text.size() + 1);
        entry.from_client = true;
        entry.means = protocol::request_words(parse_request(*std::move(line), device_.profile()));
        take_(std::move(entry));
    }
}

void WireListener::said(const protocol::Send& message) {
    std::string_view rest = message.bytes;
    const std::string_view line = take_line(rest);
    WireEntry entry = begin(line, message.bytes.size());
    const auto status = status_in(take_line(rest));
    if (status) {
        const auto echo = protocol::parse_request({std::string(line)}, device_.profile());
        entry.status = status->text();
        entry.means = protocol::reply_words(echo, *status);
        entry.explains = protocol::status_words(echo.command, *status);
        if (const auto scan = device_.latest_scan(); scan && has_scan(echo, *status))
            entry.scan = scan->revolution;
    } else {
        entry.means = "a reply in SCIP 1.1, or one that a fault has damaged";
    }
    take_(std::move(entry));
}

void WireListener::dropped() {
    WireEntry entry = begin({}, 0);
    entry.means = "the client reads too slowly: the message before this is dropped";
    take_(std::move(entry));
}

}  // namespace scipd::daemon
