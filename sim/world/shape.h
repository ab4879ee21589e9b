// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The geometry of one object in its own frame. A shape stays as exact as the world file gives it: a
// sphere is a sphere. Backends that need triangles call tessellate(). The reference backend
// intersects the shapes themselves. Values, for any thread.
#pragma once

#include <memory>
#include <variant>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "sim/world/mesh.h"

namespace scipd::sim {

/// Its centre is the frame's origin, its edges are along the axes.
struct Box {
    glm::dvec3 size_m;
};

/// Its centre is the origin, its axis is z, and both ends are closed.
struct Cylinder {
    double radius_m;
    double length_m;
};

struct Sphere {
    double radius_m;
};

/// A rectangle in the plane z = 0, with its centre at the origin. It is seen from both sides.
struct Plane {
    glm::dvec2 size_m;
};

/// Many objects may share the mesh of one file.
using SharedMesh = std::shared_ptr<const Mesh>;

using Shape = std::variant<Box, Cylinder, Sphere, Plane, SharedMesh>;

/// How far a tessellated surface may lie from the true one.
inline constexpr double chord_tolerance_m = 1e-4;

/// Returns triangles that lie within the tolerance of the shape, some inside it and some outside.
/// Boxes, planes and meshes are exact. A sphere with a radius above 20 m gets a million triangles
/// and no more, so its triangles lie farther off.
Mesh tessellate(const Shape& shape, double tolerance_m = chord_tolerance_m);

// Worlds have more shapes. They are triangles from the start, within chord_tolerance_m as well.

/// Its centre is the origin, its axis is z. length_m is the length of the straight part, without
/// the two half spheres.
Mesh capsule_mesh(double radius_m, double length_m);

/// Its axis is z. The base lies at z = -length_m / 2, the tip at z = length_m / 2.
Mesh cone_mesh(double radius_m, double length_m);

/// Its centre is the origin, its half axes are along the frame's axes.
Mesh ellipsoid_mesh(const glm::dvec3& radii_m);

}  // namespace scipd::sim
