// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "testing/wire_heard.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "tools/control_client.h"

namespace scipd::testing {
namespace {

// An hour of a scanner at 40 Hz takes more, and a test that fails has its reason near its end.
constexpr std::size_t most_messages = 20'000;

WireMessage message_of(const Json& told) {
    const Json& status = told.at("status");
    return {.sensor = told.at("sensor"),
            .client = told.at("client"),
            .time_s = told.at("time_s"),
            .from_client = told.at("from") == "client",
            .line = told.at("line"),
            .status = status.is_null() ? std::string() : status.get<std::string>(),
            .means = told.at("means")};
}

/// A scan of /stream as scipcat reads it. Null: it is none, but a fault, or of a camera.
Json recorded(const Json& told) {
    if (!told.contains("sent_mm")) return nullptr;
    const double step_rad = 2.0 * std::numbers::pi / told.at("steps_per_turn").get<double>();
    const int first_step = told.at("first_step");
    const int front_step = told.at("front_step");
    return {{"host_time_s", told.at("time_s")},
            {"serial", told.at("sensor")},
            {"stamp_ms", told.at("stamp_ms")},
            {"first_step", first_step},
            {"first_angle_rad", (first_step - front_step) * step_rad},
            {"angle_increment_rad", step_rad},
            {"distances_mm", told.at("sent_mm")},
            {"intensities", told.at("intensity")}};
}

}  // namespace

WireLog::WireLog(const std::string& control, const std::vector<std::string>& scanners) {
    for (const std::string& scanner : scanners) {
        listeners_.emplace_back(control, "/wire?sensor=" + tools::path_segment(scanner),
                                [this](const std::string& text) { hear(text); });
    }
}

void WireLog::hear(const std::string& text) {
    WireMessage message = message_of(Json::parse(text));
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
    if (messages_.size() > most_messages) messages_.pop_front();
    news_.notify_all();
}

std::vector<WireMessage> WireLog::messages() const {
    const std::lock_guard lock(mutex_);
    return {messages_.begin(), messages_.end()};
}

WireMessage WireLog::wait_for(const std::string& request, std::chrono::milliseconds timeout) const {
    std::unique_lock lock(mutex_);
    auto found = messages_.end();
    const bool has_come = news_.wait_for(lock, timeout, [&] {
        found = std::ranges::find_if(messages_, [&](const WireMessage& message) {
            return message.from_client && message.line.starts_with(request);
        });
        return found != messages_.end();
    });
    if (has_come) return *found;
    std::string asked;
    for (const WireMessage& message : messages_)
        asked += message.from_client ? " " + message.line : "";
    throw ScipdError("no client has asked " + request + " in time; so far they have asked" +
                     (asked.empty() ? " nothing" : ":" + asked));
}

void WireLog::catch_up() const {
    for (const Listener& listener : listeners_)
        listener.catch_up();
}

LastScans::LastScans(const std::string& control, std::chrono::duration<double> seconds)
    : seconds_(seconds.count()),
      listener_(control, "/stream", [this](const std::string& text) { hear(text); }) {}

void LastScans::hear(const std::string& text) {
    Json scan = recorded(Json::parse(text));
    if (scan.is_null()) return;
    const double time_s = scan.at("host_time_s");
    const std::lock_guard lock(mutex_);
    kept_.push_back({time_s, std::move(scan)});
    while (kept_.front().time_s < time_s - seconds_)
        kept_.pop_front();
}

std::string LastScans::lines() const {
    const std::lock_guard lock(mutex_);
    std::string lines;
    for (const Kept& kept : kept_)
        lines += kept.scan.dump() + "\n";
    return lines;
}

}  // namespace scipd::testing
