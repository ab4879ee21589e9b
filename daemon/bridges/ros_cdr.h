// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Messages of ROS 2 that tell where something is, from the bytes that DDS carries. Their fields are
// those of the .msg files of common_interfaces and geometry2. Values; any thread.
#pragma once

#include <span>
#include <string_view>

#include "daemon/bridges/heard.h"
#include "sim/expected.h"

namespace scipd::daemon {

/// The types that can be read, "nav_msgs/Odometry".
std::span<const std::string_view> readable_ros_types();

/// "nav_msgs/Odometry" of the name that the type has in DDS, "nav_msgs::msg::dds_::Odometry_". Of
/// a name that is none of ROS 2, the name itself.
std::string ros_type_of(std::string_view dds_type);

/// One message of a readable type, with its header of CDR. Refused where it is damaged or tells of
/// no place, such as a rotation without a direction.
sim::Expected<Heard> read_ros_message(std::string_view type, std::string_view bytes);

}  // namespace scipd::daemon
