// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace scipd::sim {

/// A file that libsdformat is given in place of the user's.
struct StandIn {
    std::filesystem::path file;  ///< as the user knows it
    bool same_lines;
    /// Of a robot, which is not read as it is written.
    std::string robot = {};
    std::map<std::string, int> lines = {};  ///< of its links, by name
};

}  // namespace scipd::sim
