// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The messages of ROS that are scans, sensor_msgs/LaserScan and sensor_msgs/MultiEchoLaserScan, as
// ROS 1 writes them and as ROS 2 does (CDR, either end first). Any thread; nothing shared.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/expected.h"
#include "sim/recording/values/recorded_scan.h"

namespace scipd::sim {

enum class RosEncoding { ros1, cdr };

enum class LaserType { laser_scan, multi_echo_laser_scan };

/// The type named "sensor_msgs/LaserScan" or, in ROS 2, "sensor_msgs/msg/LaserScan", or that of
/// several echoes; nothing for others.
[[nodiscard]] std::optional<LaserType> laser_type(std::string_view type_name);

struct LaserMessage {
    RecordedScan scan;  ///< in metres; its host time is the stamp of the header, if that is not 0
    double min_range_m = 0;
    double max_range_m = 0;
};

[[nodiscard]] Expected<LaserMessage> parse_laser(std::string_view bytes, LaserType type,
                                                 RosEncoding encoding);

}  // namespace scipd::sim
