// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The <state> of a world that Gazebo Classic has saved: where its models and links lay then, and
// how they were scaled. Values; any thread.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/world/pose.h"

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

struct SdfState {
    struct Entry {
        Pose world_from_here;
        glm::dvec3 scale{1.0};  ///< of the shapes in a model's own links, not of where they lie
        int line = 0;
        bool is_used = false;
    };
    /// By MODEL, MODEL::LINK, MODEL::NESTED and so on.
    std::map<std::string, Entry, std::less<>> entries;
    std::set<std::string, std::less<>> deleted;

    /// Nothing where the state does not speak of it.
    const Entry* use(const std::string& name);
    /// A warning of what it speaks of and nobody has used; empty where there is nothing.
    [[nodiscard]] std::string unused(const std::filesystem::path& file) const;
};

/// Takes every <state> out of a world. The first counts, as in Gazebo Classic: models that it
/// inserts become the world's. Each warning begins with its place in `file`.
SdfState take_state(tinyxml2::XMLElement& world, const std::filesystem::path& file,
                    std::vector<std::string>& warnings);

}  // namespace scipd::sim
