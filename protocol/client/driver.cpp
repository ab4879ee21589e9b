// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/client/driver.h"

#include <utility>
#include <variant>

#include "protocol/char_code.h"
#include "protocol/client/status_text.h"
#include "protocol/status.h"
#include "protocol/timestamp.h"

namespace scipd::protocol::client {
namespace {

using Kind = Error::Kind;

/// A peer that sends this many bytes without the awaited reply is no scanner. Systems buffer less
/// of an old stream.
constexpr std::size_t max_listened = std::size_t{1} << 20U;
constexpr std::size_t max_quoted = 32;
constexpr std::size_t scans_digits = 2;

std::string printable(std::string_view bytes) {
    std::string text;
    for (const char c : bytes)
        text.push_back(c >= ' ' && c <= '~' ? c : '.');
    return text;
}

Error damaged(std::string_view what, const std::string& why) {
    return {Kind::damaged, "the reply to " + std::string(what) + " is damaged: " + why};
}

/// Statuses that may come in place of a scan without ending the stream: unstable, and resumed.
bool passing(std::string_view text) {
    return text == status::unstable.text() || text == status::resumed.text();
}

/// Returns what a parser made of a reply, or throws its sentence as an Error.
template <typename Parsed>
Parsed expect(std::variant<Parsed, std::string> parsed, std::string_view request) {
    if (const auto* const why = std::get_if<std::string>(&parsed)) throw damaged(request, *why);
    return std::get<Parsed>(std::move(parsed));
}

}  // namespace

Driver::Driver(Transport& transport, Patience patience)
    : transport_(transport), patience_(patience) {}

// As urg_library does: QT ends whatever runs. E means that the scanner is in SCIP 1.1, 0E or 10
// that it is in adjust mode.
void Driver::connect() {
    Message reply = hello();
    if (reply.status.size() == 1) {
        (void)exchange("SCIP2.0");
        reply = hello();
    }
    if (reply.status == status::undefined.text() || reply.status == status::denied.text()) {
        (void)exchange("TM2");
        reply = hello();
    }
    if (reply.status.size() != 2) {
        throw Error(Kind::refused, "the scanner speaks SCIP 1.1 and does not switch to 2.0");
    }
}

// The empty line ends a request that an earlier client left unfinished; scanners skip it. hello()
// tries more than once, because the first reply may come glued to the end of half a scan.
Message Driver::hello() {
    constexpr int tries = 3;
    std::optional<Message> reply;
    begin_listening();
    for (int i = 0; i < tries && (!reply || reply->damage); ++i) {
        decoder_.reset();
        transport_.write("\n");
        reply = exchange("QT");
    }
    if (!reply) give_up("QT", timed_out("answer to QT", patience_.reply, maybe_busy));
    if (reply->damage) throw damaged("QT", describe(*reply->damage));
    return *std::move(reply);
}

Version Driver::version() {
    return expect(parse_version(ask("VV")), "VV");
}

Parameters Driver::parameters() {
    return expect(parse_parameters(ask("PP")), "PP");
}

SensorState Driver::state() {
    return expect(parse_state(ask("II")), "II");
}

void Driver::switch_laser_on() {
    (void)ask("BM", status::already_on);
}

void Driver::reset() {
    (void)ask("RS");
}

ScanMessage Driver::single_scan(const ScanRequest& request) {
    const std::string line = single_scan_line(request);
    return expect(parse_scan(ask(line)), line);
}

void Driver::start(const ScanRequest& request) {
    const std::string line = stream_line(request);
    (void)ask(line);
    stream_ = line.substr(0, line.size() - scans_digits);
}

ScanMessage Driver::next_scan() {
    begin_listening();
    while (!exhausted()) {
        const auto message = receive(patience_.scan);
        if (!message) break;
        auto scan = parse_scan(*message);
        if (auto* const good = std::get_if<ScanMessage>(&scan)) return std::move(*good);
        if (message->damage || message->status == status::scan_follows.text()) {
            ++damaged_scans_;
        } else if (message->echo.starts_with(stream_) && !passing(message->status)) {
            throw Error(Kind::refused, "the stream has ended with " + describe_status(*message));
        }
    }
    give_up("a scan", timed_out("scan", patience_.scan));
}

void Driver::stop() {
    stream_.clear();
    (void)ask("QT");
}

void Driver::enter_adjust() {
    (void)ask("TM0", status::already_in);
}

std::uint32_t Driver::time_ms() {
    return static_cast<std::uint32_t>(time("TM1", timestamp_width));
}

std::uint64_t Driver::time_us() {
    return time("%TM1", microsecond_stamp_width);
}

std::uint64_t Driver::time(std::string_view request, std::size_t width) {
    const Message reply = ask(request);
    const auto time = reply.lines.size() == 1 && reply.lines.front().size() == width
                          ? decode(reply.lines.front())
                          : std::nullopt;
    if (!time) throw damaged(request, "it has no time");
    return *time;
}

void Driver::leave_adjust() {
    (void)ask("TM2", status::not_in);
}

Message Driver::ask(std::string_view request, Status also_fine) {
    begin_listening();
    auto reply = exchange(request);
    if (!reply) give_up(request, timed_out("answer to " + std::string(request), patience_.reply));
    if (reply->damage) throw damaged(request, describe(*reply->damage));
    if (reply->status != status::ok.text() && reply->status != also_fine.text()) {
        throw Error(Kind::refused, "the scanner refused " + std::string(request) + " with " +
                                       describe_status(*reply));
    }
    return *std::move(reply);
}

/// Skips scans of a stream and replies to earlier requests that come first.
std::optional<Message> Driver::exchange(std::string_view request) {
    transport_.write(std::string(request) + "\n");
    while (!exhausted()) {
        auto message = receive(patience_.reply);
        if (!message || message->echo == request) return message;
    }
    return std::nullopt;
}

std::optional<Message> Driver::receive(std::chrono::milliseconds timeout) {
    for (;;) {
        if (auto message = decoder_.next(unread_)) return message;
        const std::size_t count = exhausted() ? 0 : transport_.read(buffer_, timeout);
        if (count == 0) return std::nullopt;
        unread_ = std::string_view(buffer_.data(), count);
        listened_ += count;
        heard_.append(unread_.substr(0, max_quoted - heard_.size()));
    }
}

bool Driver::exhausted() const {
    return listened_ > max_listened;
}

void Driver::begin_listening() {
    listened_ = 0;
    heard_.clear();
}

void Driver::give_up(std::string_view waiting_for, const Error& silent) const {
    if (heard_.empty()) throw silent;
    throw Error(Kind::foreign, "what answers there does not speak SCIP (waited for " +
                                   std::string(waiting_for) + ", heard \"" + printable(heard_) +
                                   "\")");
}

}  // namespace scipd::protocol::client
