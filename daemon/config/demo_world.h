// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What comes with scipd in scenes/: the world that it shows when nobody names one, materials and
// models. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <vector>

#include "sim/expected.h"
#include "sim/world/pose.h"

namespace scipd::daemon {

/// The rescue maze: where it was installed beside this program, else in the sources that it was
/// built from. A fault says where it was sought.
sim::Expected<std::filesystem::path> demo_scene();

/// The library of materials that comes with scipd. A fault says where it was sought.
sim::Expected<std::filesystem::path> stock_materials();

/// Where the models may be that come with scipd; worlds for Gazebo include two of them without
/// bringing them along, sun and ground_plane.
std::vector<std::filesystem::path> stock_models();

/// Where the maze begins, and a scanner on a robot's deck: high enough to look over its own base.
sim::Pose demo_start();
sim::Pose demo_mount();

}  // namespace scipd::daemon
