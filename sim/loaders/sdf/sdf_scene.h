// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Builds a scene from the tree of a world. Any thread; nothing shared.
#pragma once

#include <filesystem>

#include "sim/loaders/file/scene_draft.h"
#include "sim/loaders/resources/resources.h"
#include "sim/loaders/sdf/sdf_options.h"
#include "sim/loaders/sdf/sdf_reader.h"

namespace scipd::sim {

/// `file` is what the user asked for, for messages.
void add_to_scene(SdfTree tree, const std::filesystem::path& file, const Resources& resources,
                  const SdfOptions& options, SceneDraft& draft);

}  // namespace scipd::sim
