// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a change makes of a scene. Touches nothing that runs; any thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "daemon/limits/limit.h"
#include "daemon/world/scene_edit.h"
#include "sim/expected.h"
#include "sim/loaders/scene_file.h"
#include "sim/world/scene.h"

namespace scipd::daemon {

/// How many triangles each model has that was added since the world was loaded.
using AddedTriangles = std::map<std::string, std::size_t>;

/// What an edit changes.
struct PresentScene {
    std::filesystem::path file;
    sim::SharedScene scene;
    sim::SceneOptions options;
    std::vector<std::filesystem::path> allow;
    AddedTriangles added;
    LimitValues limits;
};

/// The new scene, before its backends are made.
struct EditedScene {
    std::filesystem::path file;
    sim::SharedScene scene;
    sim::SharedScene added;  ///< what of it is new
    std::vector<std::string> warnings;
    std::vector<std::string> notes;
    AddedTriangles all_added;
};

/// An error is an outcome that is told as it is; what cannot be loaded is thrown as a LoadError.
using EditedOrNot = tl::expected<EditedScene, EditOutcome>;

[[nodiscard]] EditedOrNot edited(const SceneEdit& edit, PresentScene present);

}  // namespace scipd::daemon
