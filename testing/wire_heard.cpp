// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "testing/wire_heard.h"

#include <algorithm>
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

}  // namespace scipd::testing
