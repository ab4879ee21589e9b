// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A URDF robot as SDF, through libsdformat. Alone, the library drops every link without inertia,
// lumps links together where a joint is fixed and forgets the names of materials; a scanner sees
// shapes whatever they weigh, and wants to name what it sees. Call it while an SdfConsole is held.
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

/// The robot as an SDF document, every link of it, with all joints at zero, and what its <gazebo>
/// extensions have of sensors, as offer_sensors() leaves it; they themselves stay in it if strict,
/// and so does what is nothing to a scanner (urdf_document.h). What the library has against it is
/// on the console; empty where it makes nothing of it.
std::string sdf_from_urdf(std::string_view text, const std::filesystem::path& file,
                          const SdfOptions& options, std::vector<FoundSensor>& sensors,
                          std::vector<std::string>& warnings);

/// The lines of its links, by name.
std::map<std::string, int> lines_of_links(std::string_view text);

/// The line of the link or joint that a message of the library names in brackets; 0 where none.
int line_in_urdf(std::string_view text, const std::string& message);

}  // namespace scipd::sim
