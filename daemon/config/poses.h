// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads the start of a robot (`pose`), the source of its live poses (`poses`, in a file or on the
// command line), and the policy where there are none. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "daemon/config/claims.h"
#include "daemon/config/config.h"
#include "sim/expected.h"
#include "sim/loaders/yaml/yaml_section.h"

namespace scipd::daemon {

/// udp:ADDR:PORT, gz:[/TOPIC], ros2:/TOPIC, rosbridge:ws://HOST:PORT/TOPIC,
/// vda5050:MANUFACTURER[/SERIAL], - or a file that exists.
sim::Expected<PoseSource> parse_pose_source(std::string_view text,
                                            const std::filesystem::path& base);

/// The source as a user names it.
std::string text_of(const PoseSource& source);

/// What xyz and rpy of this section say; each is zeros where it is left out. Angles that look like
/// degrees are a warning.
sim::Pose pose_in(const sim::YamlSection& section, sim::YamlFaults& faults);

/// The pose under this key, {xyz: [..], rpy: [..]}. Each is zeros where it is left out, and so are
/// both where the key is not there.
sim::Pose read_pose(const sim::YamlSection& parent, std::string_view key, sim::YamlFaults& faults);

/// Reads `poses: SOURCE`, or a map with `from: SOURCE` and more, into the robot and its sensors.
/// `field` is the value of the robot's key `poses`.
void read_poses(const sim::YamlField& field, RobotConfig& robot, const std::filesystem::path& base,
                Claims& claims, sim::YamlFaults& faults);

/// Policy for times without a pose. Live poses on the wall clock are extrapolated unless the
/// configuration says what comes after the last one.
[[nodiscard]] sim::PosePolicy pose_policy(const Config& config, const RobotConfig& robot);

}  // namespace scipd::daemon
