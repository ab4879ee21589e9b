// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Poses as a user types them, and as the control API sends them. No thread rule.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "sim/loaders/poses/pose_line.h"
#include "sim/world/pose.h"

namespace scipd::tools {

/// Reads X,Y,YAW or X,Y,Z,R,P,Y in metres and radians; nothing if the text is neither.
[[nodiscard]] std::optional<sim::Pose> parse_pose_text(std::string_view text);

/// Tells on standard error where the angles of such a pose look like degrees.
void warn_of_degrees(std::string_view text);

/// Writes X,Y,Z,R,P,Y, which parse_pose_text() reads.
[[nodiscard]] std::string pose_text(const sim::Pose& pose);

/// The body of PUT .../pose, without the robot's name.
[[nodiscard]] nlohmann::ordered_json pose_body(const sim::PoseLine& line);

}  // namespace scipd::tools
