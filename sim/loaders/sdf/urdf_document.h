// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A URDF robot on its way to libsdformat 12, which refuses all of it for a joint without limits or
// a friction that is no number. What is nothing to a scanner is taken out before the library sees
// it, as sdf_document.h does for SDF. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/loaders/sdf/sdf_options.h"

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// Leaves links, where they lie and what they look like; a visual that cannot be read goes alone,
/// or a collision where scanners see those. Answers with warnings that begin with their place in
/// `file`.
std::vector<std::string> relieve_robot(tinyxml2::XMLElement& robot,
                                       const std::filesystem::path& file, SdfGeometry geometry);

}  // namespace scipd::sim
