// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Bags of ROS 2 that rosbag2 has stored in SQLite (.db3), the file itself without metadata.yaml.
// Messages that were packed one by one are unpacked. Any thread; nothing shared.
#pragma once

#include <memory>

#include "sim/recording/file/input_file.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {

[[nodiscard]] Expected<std::unique_ptr<Recording>> open_db3(InputFile file);

}  // namespace scipd::sim
