// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The tree of a URDF robot, which the library refuses as a whole for one joint that hangs on
// nothing. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// Leaves one tree of all links that have a name: what of a joint cannot be read or fits nowhere is
/// left out, and links that hang on no joint then stand at the origin of the robot. Answers with
/// warnings that begin with their place in `file`.
std::vector<std::string> mend_tree(tinyxml2::XMLElement& robot, const std::filesystem::path& file);

}  // namespace scipd::sim
