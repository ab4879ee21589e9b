// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One line of a TUM trajectory: `t tx ty tz qx qy qz qw`, without its line end. Files and pose
// streams share it. Any thread; nothing shared.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include <glm/vec4.hpp>

#include "sim/loaders/poses/trajectory.h"

namespace scipd::sim {

/// The pose, or a sentence that names the column at fault.
std::variant<TimedPose, std::string> parse_tum_line(std::string_view line);

/// Unit length, or nothing where there is no direction in it. Order as in files: x, y, z, w.
std::optional<glm::dquat> normalised_quaternion(double x, double y, double z, double w);

/// The same of a file, whose quaternions have length 1 as far as two decimals allow; or why it is
/// none, in which `columns` are what it was read from.
std::variant<glm::dquat, std::string> quaternion_in_file(const glm::dvec4& xyzw,
                                                         const std::string& columns);

}  // namespace scipd::sim
