// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Mends the names in an SDF document for libsdformat. It wants every part to have a name, none of
// its reserved names, and each name only once in its scope. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// The name of the model that an <include> brings, if the include itself gives none; empty if the
/// model has none.
using NameOfInclude = std::function<std::string(const tinyxml2::XMLElement& include)>;

/// Renames what the library would refuse, as Gazebo Classic does: NAME_0. Returns warnings, each of
/// which begins with its place in `file`.
std::vector<std::string> mend_names(tinyxml2::XMLElement& root, const std::filesystem::path& file,
                                    const NameOfInclude& name_of);

/// The name of an element, or of an include in its <name>; empty if none.
std::string own_name(const tinyxml2::XMLElement& element);

/// MODEL::LINK::VISUAL, from the outermost model to this element.
std::string path_of(const tinyxml2::XMLElement& element);

}  // namespace scipd::sim
