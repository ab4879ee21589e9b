// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Messages of Gazebo that tell where something is, from their bytes. The fields are those of
// pose.proto, pose_v.proto, odometry.proto and clock.proto, whose numbers are the same in
// ignition-msgs and gz-msgs. Values; any thread.
#pragma once

#include <string>
#include <string_view>

#include "daemon/bridges/heard.h"
#include "sim/expected.h"

namespace scipd::daemon {

/// "Pose_V" of "gz.msgs.Pose_V" and of "ignition.msgs.Pose_V"; of another name, the name itself.
std::string_view plain_gz_type(std::string_view type);

/// Whether a type tells where something is.
bool is_readable_gz_type(std::string_view type);

/// One message. Refused where it is damaged or tells of no place.
sim::Expected<Heard> read_gz_message(std::string_view type, std::string_view bytes);

}  // namespace scipd::daemon
