// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What comes from a source of poses, for people who wonder why a robot does not move. Values; any
// thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "daemon/config/poses.h"

namespace scipd::daemon {

struct SourceReport {
    std::string robot;
    std::string source;               ///< "ros2:/odom"
    std::optional<std::string> type;  ///< of what came last, "nav_msgs/Odometry"; lines have none
    std::uint64_t messages = 0;       ///< that have come, or lines
    std::uint64_t refused = 0;
    std::uint64_t lost = 0;              ///< since more came than was taken
    double rate_hz = 0.0;                ///< of the last seconds
    std::optional<double> age_s;         ///< since the last one came
    std::optional<double> late_ms;       ///< the mean of the last seconds
    std::optional<double> most_late_ms;  ///< the latest of them
    std::vector<std::string> troubles;   ///< what is not there, with the names that are
};

}  // namespace scipd::daemon
