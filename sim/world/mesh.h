// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <vector>

#include <glm/vec3.hpp>

namespace scipd::sim {

/// Triangles in the frame of the object that they belong to. Indices are below vertices_m.size();
/// winding does not matter, since a laser sees both sides of a face.
struct Mesh {
    std::vector<glm::vec3> vertices_m;
    std::vector<glm::uvec3> triangles;
};

}  // namespace scipd::sim
