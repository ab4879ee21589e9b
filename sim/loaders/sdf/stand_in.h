// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace scipd::sim {

/// A file that libsdformat reads in place of the user's.
struct StandIn {
    std::filesystem::path file;  ///< the user's file
    bool same_lines;
    /// The URDF of a robot, which the library gets converted to SDF.
    std::string robot = {};
    std::map<std::string, int> lines = {};  ///< of the robot's links, by name
};

}  // namespace scipd::sim
