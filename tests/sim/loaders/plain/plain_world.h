// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A second reader of worlds, for tests: plain XML, no libsdformat, no Assimp, and nothing of sim/.
// It reads only what is well made, and knows boxes, cylinders, spheres, planes and meshes in OBJ.
// What it casts is in closed form, in double.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <variant>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace scipd::tests {

struct PlainBox {
    glm::dvec3 half_m;
};
struct PlainCylinder {
    double radius_m;
    double half_length_m;
};
struct PlainSphere {
    double radius_m;
};
struct PlainRectangle {
    glm::dvec2 half_m;
};
using PlainTriangles = std::vector<std::array<glm::dvec3, 3>>;
using PlainShape =
    std::variant<PlainBox, PlainCylinder, PlainSphere, PlainRectangle, PlainTriangles>;

struct PlainThing {
    glm::dmat4 world_from_thing;
    PlainShape shape;
};

using PlainWorld = std::vector<PlainThing>;

/// What the visuals of an SDF or URDF file show. Throws std::runtime_error on anything unknown.
PlainWorld read_plain_world(const std::filesystem::path& file);

/// From the origin of this frame along `direction`, of unit length; nothing where nothing is hit.
std::optional<double> plain_range_m(const PlainWorld& world, const glm::dvec3& from_m,
                                    const glm::dvec3& direction);

}  // namespace scipd::tests
