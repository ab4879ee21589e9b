// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where the poses of a robot come from, from the text that a user wrote, in a file or on the
// command line. As in values.h, a Fault has no field. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "daemon/config/config.h"
#include "sim/expected.h"

namespace scipd::daemon {

/// udp:ADDR:PORT, gz:[/TOPIC], ros2:/TOPIC, rosbridge:ws://HOST:PORT/TOPIC,
/// vda5050:MANUFACTURER[/SERIAL], - or a file that exists.
sim::Expected<PoseSource> parse_pose_source(std::string_view text,
                                            const std::filesystem::path& base);

/// As a user names it.
std::string text_of(const PoseSource& source);

}  // namespace scipd::daemon
