// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One model that a running scene is to have besides its own: a scene of its own that
// with_models() takes. It can be moved unless it says that it is static. Any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "sim/loaders/file/loaded_scene.h"
#include "sim/loaders/sdf/sdf_options.h"

namespace scipd::sim {

struct Placement {
    std::string name;                                     ///< in place of the model's own
    std::optional<Pose> world_from_model = std::nullopt;  ///< its own where there is none
    /// As one body, or nothing of it, whatever its file says; what that says where there is none.
    std::optional<bool> movable = std::nullopt;
};

/// The same for what comes while scanners run, from whoever can reach the daemon: a model, not a
/// world, and so a part of the memory that a world may take.
SdfOptions within_a_models_share(SdfOptions options);

/// From a text (a <model>, a URDF <robot>, or a document with one of them) or, where `folder` is
/// given, with relative URIs that start there. Throws LoadError, whose messages call the text by
/// the model's name.
LoadedScene load_model_text(const std::string& text, const Placement& placement,
                            const std::filesystem::path& folder, const SdfOptions& options = {});

/// A world of one model as that model; `source` is its file, for messages. Throws LoadError.
LoadedScene as_model(LoadedScene loaded, const Placement& placement, const std::string& source);

/// From a mesh file. A material of its own stands in for those of the file; empty keeps them.
LoadedScene load_mesh_model(const std::filesystem::path& file, const Placement& placement,
                            double scale = 1.0, const std::string& material = {},
                            const MeshLimits& limits = {});

}  // namespace scipd::sim
