// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Bags of ROS: format 2.0 of ROS 1, also of a recorder that was killed (.bag.active), and the
// SQLite files of rosbag2, whose messages may be packed one by one by Zstandard. Any thread;
// nothing shared.
#pragma once

#include <memory>

#include "sim/recording/file/recording_file.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {

/// Refuses bags of format 1, with what to do.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_bag(InputFile file);
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_db3(InputFile file);

}  // namespace scipd::sim
