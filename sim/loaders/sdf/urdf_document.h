// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Prepares a URDF robot for libsdformat 12, which refuses the whole robot for a joint without
// limits or a friction that is not a number. So scipd first takes out what does not matter to a
// scanner, as sdf_document.h does for SDF. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/loaders/sdf/sdf_options.h"

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// Keeps the links, their poses and their shapes. It takes out each visual that cannot be read, or
/// each such collision if scanners see collisions. Returns warnings, each of which begins with its
/// place in `file`.
std::vector<std::string> relieve_robot(tinyxml2::XMLElement& robot,
                                       const std::filesystem::path& file, SdfGeometry geometry);

}  // namespace scipd::sim
