// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One line of a stream of poses, in metres: a JSON object or a TUM line (`t tx ty tz qx qy qz
// qw`), as it comes from a file, standard input, a datagram or a request. Any thread; nothing
// shared.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <glm/vec4.hpp>
#include <nlohmann/json_fwd.hpp>

#include "sim/expected.h"
#include "sim/loaders/poses/trajectory.h"
#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::sim {

/// What a pose line says. At most one of `robot` and `model` is set. Where neither is, the line
/// means the only robot.
struct PoseLine {
    std::string robot;
    std::string model;
    std::optional<Time> time;
    Pose pose;
    std::optional<Velocity> velocity;
};

/// Whether a line is empty or a comment. Readers of streams skip such lines; parse_pose_line()
/// refuses them.
bool says_nothing(std::string_view line);

/// Understands a line. A Fault's field is the key of the JSON object that is wrong, or "t" of a TUM
/// line, and its sentence names the field, too. Never throws on any bytes.
Expected<PoseLine> parse_pose_line(std::string_view line);

/// Takes a JSON object that has been read already.
Expected<PoseLine> pose_line_in(const nlohmann::json& object);

/// The pose, or a sentence that names the column that is wrong.
Expected<TimedPose> parse_tum_line(std::string_view line);

/// The quaternion with length 1, or nothing where it is too short or too long to have a direction.
/// The order is that of files: x, y, z, w.
std::optional<glm::dquat> normalised_quaternion(double x, double y, double z, double w);

/// A quaternion in a file must have length 1 within the rounding of two decimals. A fault names the
/// `columns` that it was read from.
Expected<glm::dquat> quaternion_in_file(const glm::dvec4& xyzw, const std::string& columns);

}  // namespace scipd::sim
