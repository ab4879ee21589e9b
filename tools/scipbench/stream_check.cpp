// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/stream_check.h"

#include <algorithm>
#include <cmath>

#include "protocol/char_code.h"
#include "protocol/checksum.h"
#include "protocol/timestamp.h"

namespace scipd::tools {
namespace {

using protocol::client::ScanRequest;

/// Digits at the end of a request and of its echo: how many scans are still to come.
constexpr std::size_t count_digits = 2;
constexpr std::string_view end_of_message = "\n\n";

std::string echo_of(const ScanRequest& request) {
    std::string line = stream_line(request);
    line.resize(line.find_last_not_of("\r\n") + 1 - count_digits);
    return line;
}

/// Takes a line off the front; the last one may lack its line end.
std::string_view next_line(std::string_view& lines) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    const std::string_view line = lines.substr(0, end);
    lines.remove_prefix(std::min(end + 1, lines.size()));
    return line;
}

/// The line without its sum; nothing where the sum is wrong.
std::optional<std::string_view> text_of(std::string_view line) {
    if (line.empty()) return std::nullopt;
    const std::string_view text = line.substr(0, line.size() - 1);
    return protocol::checksum(text) == line.back() ? std::optional(text) : std::nullopt;
}

}  // namespace

StreamFindings& StreamFindings::operator+=(const StreamFindings& other) {
    bytes += other.bytes;
    scans += other.scans;
    missing += other.missing;
    damaged += other.damaged;
    disordered += other.disordered;
    return *this;
}

StreamCheck::StreamCheck(const ScanRequest& request, Milliseconds period)
    : echo_(echo_of(request)),
      data_size_(request.groups() * static_cast<std::size_t>(request.width) *
                 (request.intensity ? 2 : 1)),
      period_(period * (request.interval + 1)) {}

void StreamCheck::take(std::string_view bytes, Time now) {
    findings_.bytes += bytes.size();
    rest_.append(bytes);
    std::string_view unread = rest_;
    for (std::size_t end = unread.find(end_of_message); end != unread.npos;
         end = unread.find(end_of_message)) {
        take_message(unread.substr(0, end), now);
        unread.remove_prefix(end + end_of_message.size());
    }
    rest_.erase(0, rest_.size() - unread.size());
}

void StreamCheck::take_message(std::string_view message, Time now) {
    if (!answered_ && is_answer(message)) {
        answered_ = true;
    } else if (const auto stamp = stamp_ms(message)) {
        ++findings_.scans;
        follow(*stamp, now);
    } else {
        ++findings_.damaged;
    }
}

bool StreamCheck::is_answer(std::string_view message) const {
    const std::string_view echo = next_line(message);
    return echo.starts_with(echo_) && message == "00P";
}

std::optional<std::uint32_t> StreamCheck::stamp_ms(std::string_view message) const {
    const std::string_view echo = next_line(message);
    if (!echo.starts_with(echo_) || echo.size() != echo_.size() + count_digits) return {};
    if (next_line(message) != "99b") return {};
    const auto stamp = text_of(next_line(message));
    if (!stamp || stamp->size() != protocol::timestamp_width) return {};
    std::size_t size = 0;
    while (!message.empty()) {
        const auto text = text_of(next_line(message));
        if (!text) return {};
        size += text->size();
    }
    if (size != data_size_) return {};
    const auto decoded = protocol::decode(*stamp);
    return decoded ? std::optional(static_cast<std::uint32_t>(*decoded)) : std::nullopt;
}

// A scanner's clock may run some parts in a thousand too fast, and stamps are whole milliseconds.
void StreamCheck::follow(std::uint32_t stamp_ms, Time now) {
    constexpr std::uint32_t wraps_after = 1U << 24U;
    constexpr double rounding_ms = 2.0;
    constexpr double drift = 0.005;
    if (!last_stamp_ms_) first_came_ = now;
    const std::uint32_t since_ms =
        (stamp_ms - last_stamp_ms_.value_or(stamp_ms)) & (wraps_after - 1);
    if (last_stamp_ms_) {
        const double turns = std::round(since_ms / period_.count());
        const double off_ms = std::abs(since_ms - turns * period_.count());
        if (turns < 1 || since_ms > wraps_after / 2 || off_ms > rounding_ms + drift * since_ms) {
            ++findings_.disordered;
        } else {
            findings_.missing += static_cast<std::uint64_t>(turns) - 1;
        }
    }
    last_stamp_ms_ = stamp_ms;
    stamped_ms_ += since_ms;
    behind_ms_.push_back(Milliseconds(now - first_came_).count() - stamped_ms_);
}

std::vector<double> StreamCheck::delays_ms() const {
    std::vector<double> delays = behind_ms_;
    if (delays.empty()) return delays;
    const double soonest_ms = *std::ranges::min_element(delays);
    for (double& delay : delays)
        delay -= soonest_ms;
    return delays;
}

}  // namespace scipd::tools
