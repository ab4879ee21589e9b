// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One line of a log of JSON. Any thread.
#pragma once

#include <chrono>
#include <set>
#include <string>
#include <string_view>

namespace scipd::daemon {

/// What is logged. A view that is good for one call.
struct LogEntry {
    std::chrono::system_clock::time_point time;
    std::string_view level;
    std::string_view message;
};

using Sensors = std::set<std::string, std::less<>>;

/// The sensor that a message is about: such messages begin with its name and a colon, and it is one
/// of these. Empty: there is none.
[[nodiscard]] std::string_view sensor_of(std::string_view message, const Sensors& sensors);

/// {"time","level","sensor","message"} without line end, in plain ASCII. The sensor is no part of
/// the message there. Messages that are about none have none.
[[nodiscard]] std::string json_log_line(const LogEntry& entry, const Sensors& sensors);

}  // namespace scipd::daemon
