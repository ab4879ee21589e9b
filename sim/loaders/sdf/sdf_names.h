// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The names in an SDF document as libsdformat wants them: there, none of its own, and each once
// where it lies. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// What an <include> brings is called so where it does not say otherwise; empty for what stays
/// nameless.
using NameOfInclude = std::function<std::string(const tinyxml2::XMLElement& include)>;

/// Gives other names where it must, as Gazebo Classic does: NAME_0. Each warning begins with its
/// place in `file`.
std::vector<std::string> mend_names(tinyxml2::XMLElement& root, const std::filesystem::path& file,
                                    const NameOfInclude& name_of);

/// Empty where it has none; an include that does not say has none.
std::string own_name(const tinyxml2::XMLElement& element);

/// MODEL::LINK::VISUAL, from the outermost model on.
std::string path_of(const tinyxml2::XMLElement& element);

}  // namespace scipd::sim
