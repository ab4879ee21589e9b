// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Converts a URDF robot to SDF, through libsdformat. Alone, the library drops every link without
// inertia, merges links that a fixed joint connects, and forgets the names of materials. But a
// scanner sees shapes whatever they weigh, and needs their links and materials. The caller must
// hold an SdfConsole.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim/loaders/sdf/sdf_options.h"
#include "sim/loaders/sdf/sdf_sensors.h"

namespace scipd::sim {

/// Whether the root of this XML is a <robot>.
bool is_urdf(std::string_view text);

/// The robot as an SDF document, with every link, with all joints at zero, and with a frame for
/// each sensor of its <gazebo> extensions (offer_sensors()). Only if strict, the sensors themselves
/// stay in it, and so do the parts that do not matter to a scanner (urdf_document.h). The library
/// prints its complaints on the console. Empty if it cannot convert the robot.
std::string sdf_from_urdf(std::string_view text, const std::filesystem::path& file,
                          const SdfOptions& options, std::vector<FoundSensor>& sensors,
                          std::vector<std::string>& warnings);

/// The lines of the robot's links, by name.
std::map<std::string, int> lines_of_links(std::string_view text);

/// The line of the link or joint that a message of the library names in brackets; 0 if it names
/// none.
int line_in_urdf(std::string_view text, const std::string& message);

}  // namespace scipd::sim
