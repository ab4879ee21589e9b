// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The <state> of a world that Gazebo Classic saved: where its models and links were, and their
// scale. Values; any thread.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include <glm/vec3.hpp>
#include <tinyxml2.h>

#include "sim/loaders/file/scene_draft.h"
#include "sim/world/pose.h"

namespace scipd::sim {

struct SdfState {
    struct Entry {
        Pose world_from_here;
        glm::dvec3 scale{1.0};  ///< scales the shapes in a model's own links, not their poses
        int line = 0;
        bool is_used = false;
    };
    /// Keys are MODEL, MODEL::LINK, MODEL::NESTED and so on.
    std::map<std::string, Entry, std::less<>> entries;
    std::set<std::string, std::less<>> deleted;

    /// The entry of this name, which then counts as used; null if there is none.
    const Entry* use(const std::string& name);
    /// A warning about entries that were never used; empty if there are none.
    [[nodiscard]] std::string unused(const std::filesystem::path& file) const;
};

/// Reads the first <state> of a world, as Gazebo Classic does. The draft is told what cannot be
/// read, with its place in `file`.
SdfState state_of(const tinyxml2::XMLElement& world, const std::filesystem::path& file,
                  SceneDraft& draft);

}  // namespace scipd::sim
