// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A model that somebody wants to add to a scene: where it is from, and where it shall stand. A
// value.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "sim/world/pose.h"

namespace scipd::sim {

struct Placement {
    std::string name;                                     ///< replaces the model's own name
    std::optional<Pose> world_from_model = std::nullopt;  ///< none: the model's own pose
    /// True: the model moves as one body. False: no part of it moves. Without a value, as its file
    /// says.
    std::optional<bool> movable = std::nullopt;
};

struct NewModel {
    Placement placement;
    /// A <model>, a URDF <robot>, or a document with one of them. Empty: it is in the file.
    std::string text = {};
    /// Relative URIs of the text start here.
    std::filesystem::path folder = {};
    /// A file of any kind that a world may be of, or the folder of a model.
    std::filesystem::path file = {};
    std::filesystem::path mesh = {};  ///< in place of both
    double scale = 1.0;               ///< of a mesh
    std::string material = {};        ///< of a whole mesh; empty: those of its file
};

}  // namespace scipd::sim
