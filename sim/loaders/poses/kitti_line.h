// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One line of KITTI's odometry ground truth: the first three rows of a camera's pose, as a matrix,
// in the frame that the camera had at first. KITTI's cameras have x to the right, y down and z
// ahead; here both frames are turned to x ahead, y to the left, z up, as everywhere in a world. So
// the drive begins at the origin, looking along x. Any thread; nothing shared.
#pragma once

#include <string_view>

#include "sim/expected.h"
#include "sim/world/pose.h"

namespace scipd::sim {

/// The pose, or a sentence that says what is wrong.
Expected<Pose> parse_kitti_line(std::string_view line);

}  // namespace scipd::sim
