// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads the visuals and collisions of a link, and their geometry. Meshes and heights stay names of
// files: scene_shapes.h reads those. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include <tinyxml2.h>

#include "sim/loaders/parts/part.h"
#include "sim/loaders/sdf/sdf_options.h"
#include "sim/loaders/sdf/sdf_values.h"

namespace scipd::sim {

/// The document that an element is from.
struct SdfSheet {
    std::shared_ptr<const std::filesystem::path> file;
    std::filesystem::path folder;  ///< where its relative URIs start
    Dialect dialect = {};
    FilePlace changed_at = {};  ///< where elements are from that something has added, if any

    [[nodiscard]] FilePlace place(const tinyxml2::XMLElement& element) const {
        const int line = element.GetLineNum();
        return line == 0 && changed_at.file != nullptr ? changed_at : FilePlace{file, line};
    }
};

Geometry geometry_of(const tinyxml2::XMLElement& geometry, const SdfSheet& sheet);

/// What `read` returns or, if it throws an UnreadableValue or a LoadError, why it is Unread.
Geometry read_or_why(const std::function<Geometry()>& read);

/// Throws LoadError if a size is not above 0 or beyond 1e7 m.
void check_sizes(std::initializer_list<double> sizes_m);

/// Throws LoadError if the scale of a mesh makes it flat.
void check_scale(const glm::dvec3& scale);

/// Scales a shape as Gazebo Classic does: round shapes stay round. Nothing for shapes that it does
/// not scale. Throws LoadError if the result has a size of 0 or beyond 1e7 m.
std::optional<Shape> scaled(const Shape& shape, const glm::dvec3& scale);

}  // namespace scipd::sim
