// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <CLI/CLI.hpp>

namespace scipd::tools {

/// `scipfit RECORDING...`: what all of the program does where no command is named.
void add_fit_options(CLI::App& program);

/// `scipfit room RECORDING -o room.sdf`: the walls around a standing scanner, as a world.
/// `-o hall.yaml`: a ROS map of a drive.
void add_room_command(CLI::App& program);

/// `scipfit export profile.yaml --for amcl|gz|mvsim|stage`: the profile in others' words.
void add_export_command(CLI::App& program);

}  // namespace scipd::tools
