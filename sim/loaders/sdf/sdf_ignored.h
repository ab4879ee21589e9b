// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Faults of what is nothing to a scanner: Gazebo would stumble over them, so they are told, though
// no range depends on them. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// Of a document as it was written: a warning for each kind of fault, which names the first and
/// counts the others.
std::vector<std::string> faults_of_ignored(const tinyxml2::XMLElement& root,
                                           const std::filesystem::path& file);

/// The same of a URDF robot.
std::vector<std::string> faults_of_ignored_in_robot(const tinyxml2::XMLElement& robot,
                                                    const std::filesystem::path& file);

}  // namespace scipd::sim
