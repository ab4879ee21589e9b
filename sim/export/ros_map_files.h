// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A floor map as map_server of ROS 1 and of Nav2 read it: a picture and a YAML file. Any thread.
#pragma once

#include <filesystem>
#include <string>

#include "sim/expected.h"
#include "sim/export/floor_map.h"

namespace scipd::sim {

/// A portable graymap (P5): 0 is occupied, 254 free, 205 unknown. The first row is the one with
/// the greatest y.
std::string pgm_of(const FloorMap& map);

/// The thresholds are those of ROS 1: a free_thresh of 0.25, as Nav2 writes it, would make 205
/// free. `picture` is the name of the picture's file.
std::string yaml_of(const FloorMap& map, const std::string& picture);

/// Writes the YAML file, and the picture of the same name, with .pgm, beside it. The answer is
/// for the user. Refused if the name does not end with .yaml, or a file cannot be written.
Expected<std::string> write_ros_map(const FloorMap& map, const std::filesystem::path& yaml);

}  // namespace scipd::sim
