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

/// {"time","level","sensor","message"} without line end, in plain ASCII. Messages about a sensor
/// begin with its name and a colon: where that is one of these, it is the sensor and no part of the
/// message. Other messages have no sensor.
[[nodiscard]] std::string json_log_line(const LogEntry& entry,
                                        const std::set<std::string, std::less<>>& sensors);

}  // namespace scipd::daemon
