// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A model that is added to a running scene, as a scene of its own for with_models(). It can be
// moved unless its file says that it is static. Any thread.
#pragma once

#include <filesystem>
#include <string>

#include "sim/loaders/file/loaded_scene.h"
#include "sim/loaders/file/new_model.h"
#include "sim/loaders/sdf/sdf_options.h"

namespace scipd::sim {

/// `options` with smaller limits, for models that arrive while scanners run. Anybody who can reach
/// the daemon may send one, so it may take only a part of the memory and triangles of a world.
SdfOptions within_a_models_share(SdfOptions options);

/// Loads a model from a text: a <model>, a URDF <robot>, or a document with one of them. Relative
/// URIs start at `folder`, if it is given. Throws LoadError, whose messages call the text by the
/// model's name.
LoadedScene load_model_text(const std::string& text, const Placement& placement,
                            const std::filesystem::path& folder, const SdfOptions& options = {});

/// Turns a loaded world with one model into that model. `source` is its file, for messages. Throws
/// LoadError.
LoadedScene as_model(LoadedScene loaded, const Placement& placement, const std::string& source);

/// Loads a model from a mesh file. `material` replaces the materials of the file; empty keeps them.
LoadedScene load_mesh_model(const std::filesystem::path& file, const Placement& placement,
                            double scale = 1.0, const std::string& material = {},
                            const MeshLimits& limits = {});

}  // namespace scipd::sim
