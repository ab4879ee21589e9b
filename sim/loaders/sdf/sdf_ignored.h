// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds faults in parts that do not matter to a scanner. No range depends on them, but Gazebo would
// stumble over them, so scipd warns of them. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// Takes a document as it was written. Returns one warning for each kind of fault, which names the
/// first and counts the others.
std::vector<std::string> faults_of_ignored(const tinyxml2::XMLElement& root,
                                           const std::filesystem::path& file);

/// The same for a URDF robot.
std::vector<std::string> faults_of_ignored_in_robot(const tinyxml2::XMLElement& robot,
                                                    const std::filesystem::path& file);

}  // namespace scipd::sim
