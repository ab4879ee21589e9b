// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <CLI/CLI.hpp>

namespace scipd::tools {

/// `scipfit room RECORDING -o room.sdf`: the walls around a standing scanner, as a world.
/// `-o hall.yaml`: a ROS map of a drive.
void add_room_command(CLI::App& program);

}  // namespace scipd::tools
