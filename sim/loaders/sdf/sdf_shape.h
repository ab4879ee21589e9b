// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Turns one geometry of libsdformat into a shape of scipd. Meshes come from files, so not here. Any
// thread.
#pragma once

#include <optional>
#include <string>

#include <sdf/Geometry.hh>

#include "sim/loaders/sdf/placed_shape.h"
#include "sim/world/shape.h"

namespace scipd::sim {

/// Nothing for meshes and for kinds that scipd does not support. Throws LoadError for impossible
/// ones: sizes that are not above 0 or beyond 1e7 m, outlines of fewer than three points.
std::optional<PlacedShape> primitive_of(const sdf::Geometry& geometry);

/// Scales a shape as Gazebo Classic does: round shapes stay round. Nothing for shapes that it does
/// not scale. Throws LoadError if the result has a size of 0 or beyond 1e7 m.
std::optional<Shape> scaled(const Shape& shape, const glm::dvec3& scale);

/// SDF's name for this kind of geometry; "empty" if there is none.
std::string kind_of(const sdf::Geometry& geometry);

}  // namespace scipd::sim
