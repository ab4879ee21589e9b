// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Mends the tree of a URDF robot: the library refuses the whole robot for one joint without a valid
// parent or child. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// Makes one tree of all links that have a name. It leaves out joints, or parts of them, that
/// cannot be read or do not fit into a tree. Links without a joint then stand at the origin of the
/// robot. Returns warnings, each of which begins with its place in `file`.
std::vector<std::string> mend_tree(tinyxml2::XMLElement& robot, const std::filesystem::path& file);

}  // namespace scipd::sim
