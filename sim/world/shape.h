// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The geometry of one object in its own frame, as a world file gives it: exact where it is exact.
// Backends that need triangles call tessellate() (mesh.h); the reference backend intersects the
// shapes themselves.
#pragma once

#include <memory>
#include <variant>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "sim/world/mesh.h"

namespace scipd::sim {

/// Centred on the frame's origin, edges along its axes.
struct Box {
    glm::dvec3 size_m;
};

/// Centred on the origin, axis along z, closed at both ends.
struct Cylinder {
    double radius_m;
    double length_m;
};

struct Sphere {
    double radius_m;
};

/// A rectangle of this size in the plane through the origin that is normal to z; seen from both
/// sides.
struct Plane {
    glm::dvec2 size_m;
};

/// Shared: many objects may show the same file.
using SharedMesh = std::shared_ptr<const Mesh>;

using Shape = std::variant<Box, Cylinder, Sphere, Plane, SharedMesh>;

/// How far a tessellated surface may lie from the true one.
inline constexpr double chord_tolerance_m = 1e-4;

/// Triangles within chord_tolerance_m of the shape, some inside it and some outside. Boxes, planes
/// and meshes are exact. Spheres of more than 20 m radius are left at a million triangles and lie
/// farther off.
Mesh tessellate(const Shape& shape);

// What worlds have besides, as triangles from the start; within chord_tolerance_m as well.

/// Centred on the origin, axis along z; length_m is that of the straight part, between the two half
/// spheres.
Mesh capsule_mesh(double radius_m, double length_m);

/// Its axis along z: the base at z = -length_m / 2, the tip at z = length_m / 2.
Mesh cone_mesh(double radius_m, double length_m);

/// Centred on the origin, its half axes along the frame's.
Mesh ellipsoid_mesh(const glm::dvec3& radii_m);

}  // namespace scipd::sim
