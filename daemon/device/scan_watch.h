// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Tells scan loops that are stuck from those that wait. A loop is stuck that should have ended its
// turn, and still has not when enough time has passed between two looks at it. Whoever looks while
// the whole thread could not run, finds many loops overdue: they get their time from that look on.
// Knows no clock; one thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace scipd::daemon {

class ScanWatch {
  public:
    using Time = std::chrono::nanoseconds;

    /// A scan loop at one instant.
    struct Look {
        std::string sensor;
        std::int64_t turn = 0;  ///< that it is to end next
        bool overdue = false;   ///< it should have ended that one by now
    };

    /// How long a loop may be overdue.
    explicit ScanWatch(Time patience) : patience_(patience) {}

    /// Looks at all loops at this time, and names those that are stuck. Times never go back.
    std::vector<std::string> stuck(const std::vector<Look>& loops, Time now);

  private:
    struct Overdue {
        std::int64_t turn = 0;
        Time since{};
    };

    Time patience_;
    std::map<std::string, Overdue> overdue_;  ///< by sensor
};

}  // namespace scipd::daemon
