// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One solid as every kind of mesh file that we read, for tests. Written by hand, so that nothing
// but the reader is between the numbers here and the ranges.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace scipd::sim {

/// A box that lies alike in no two axes; its top is of steel, all else of oak.
struct Solid {
    glm::vec3 low_m{1.0F, -2.0F, 0.5F};
    glm::vec3 high_m{3.0F, 2.5F, 1.75F};
};

/// Corners in the axes and the unit of a file.
std::vector<glm::vec3> corners_of(const Solid& solid, const glm::mat3& file_from_solid);

using Triangles = std::vector<std::array<unsigned, 3>>;
const Triangles& oak_triangles();
const Triangles& steel_triangles();

using Corners = std::vector<glm::vec3>;

std::string obj_text(const Corners& corners, std::string_view mtl);
std::string mtl_text();
std::string stl_text(const Corners& corners);
std::string stl_bytes(const Corners& corners);
std::string ply_text(const Corners& corners);
std::string ply_bytes(const Corners& corners);

/// `asset` is what stands in <asset>.
std::string dae_text(const Corners& corners, std::string_view asset);

/// With its buffer inside.
std::string gltf_text(const Corners& corners);
std::string glb_bytes(const Corners& corners);

/// Without any material.
std::string plain_gltf_text(const Corners& corners);
std::string plain_dae_text(const Corners& corners);

}  // namespace scipd::sim
