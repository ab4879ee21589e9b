// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Bags of ROS 1, format 2.0, read from their beginning without the index, so that one whose
// recorder was killed (.bag.active) is read as well. Any thread; nothing shared.
#pragma once

#include <memory>

#include "sim/recording/file/input_file.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {

/// Refuses bags of format 1, with what to do.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_bag(InputFile file);

}  // namespace scipd::sim
