// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One line of a TUM trajectory: `t tx ty tz qx qy qz qw`, without its line end. Files and pose
// streams share it. Any thread; nothing shared.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <glm/vec4.hpp>

#include "sim/expected.h"
#include "sim/loaders/poses/trajectory.h"

namespace scipd::sim {

/// The pose, or a sentence that names the column that is wrong.
Expected<TimedPose> parse_tum_line(std::string_view line);

/// The quaternion with length 1, or nothing where it is too short or too long to have a direction.
/// The order is that of files: x, y, z, w.
std::optional<glm::dquat> normalised_quaternion(double x, double y, double z, double w);

/// A quaternion in a file must have length 1 within the rounding of two decimals. A fault names the
/// `columns` that it was read from.
Expected<glm::dquat> quaternion_in_file(const glm::dvec4& xyzw, const std::string& columns);

}  // namespace scipd::sim
