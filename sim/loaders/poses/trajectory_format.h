// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

namespace scipd::sim {

/// How a trajectory is written; trajectory.h says what each is.
enum class TrajectoryFormat { guess, tum, euroc, kitti, csv };

}  // namespace scipd::sim
