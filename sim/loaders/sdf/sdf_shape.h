// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One geometry of libsdformat as a shape of ours. Meshes are not its business: they come from
// files. Any thread.
#pragma once

#include <optional>
#include <string>

#include <sdf/Geometry.hh>

#include "sim/loaders/sdf/placed_shape.h"
#include "sim/world/shape.h"

namespace scipd::sim {

/// Nothing for meshes and for what we do not have. Throws LoadError where it cannot be: sizes that
/// are not above 0 or beyond 1e7 m, outlines of fewer than three points.
std::optional<PlacedShape> primitive_of(const sdf::Geometry& geometry);

/// As Gazebo Classic scales a model's shapes: what is round stays round. Nothing where it does not.
/// Throws LoadError where that makes a size of 0 or beyond 1e7 m.
std::optional<Shape> scaled(const Shape& shape, const glm::dvec3& scale);

/// What SDF calls this kind of geometry; "empty" where there is none.
std::string kind_of(const sdf::Geometry& geometry);

}  // namespace scipd::sim
