// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/mesh_blocks.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include <glm/common.hpp>

namespace scipd::sim {
namespace {

/// Small enough to leave most of a big mesh out of a thin strip, large enough that few are looked
/// at.
constexpr std::size_t block_size = 64;

/// Every third bit of the result is one of the lowest ten of `bits`.
std::uint32_t spread(std::uint32_t bits) {
    bits = (bits | (bits << 16)) & 0x030000FFU;
    bits = (bits | (bits << 8)) & 0x0300F00FU;
    bits = (bits | (bits << 4)) & 0x030C30C3U;
    return (bits | (bits << 2)) & 0x09249249U;
}

/// Triangles whose middles lie near each other get near each other (Morton's order).
void order_by_place(Mesh& mesh) {
    glm::vec3 low{mesh.vertices_m.front()};
    glm::vec3 high = low;
    for (const glm::vec3& vertex : mesh.vertices_m) {
        low = glm::min(low, vertex);
        high = glm::max(high, vertex);
    }
    const glm::vec3 to_cell = 1023.0F / glm::max(high - low, glm::vec3{1e-6F});
    std::vector<std::pair<std::uint32_t, glm::uvec3>> ordered;
    ordered.reserve(mesh.triangles.size());
    for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::vec3 middle = (mesh.vertices_m[triangle.x] + mesh.vertices_m[triangle.y] +
                                  mesh.vertices_m[triangle.z]) /
                                 3.0F;
        const glm::uvec3 cell{(middle - low) * to_cell};
        ordered.emplace_back(spread(cell.x) | spread(cell.y) << 1 | spread(cell.z) << 2, triangle);
    }
    std::ranges::stable_sort(ordered, {}, &std::pair<std::uint32_t, glm::uvec3>::first);
    std::ranges::transform(ordered, mesh.triangles.begin(),
                           &std::pair<std::uint32_t, glm::uvec3>::second);
}

/// Turns the triangles so that no corner is the first one of two, and doubles corners where that
/// cannot be. A closed mesh has half as many corners as triangles.
void give_first_corners(Mesh& mesh) {
    std::vector<bool> taken(mesh.vertices_m.size());
    for (glm::uvec3& corners : mesh.triangles) {
        for (int turn = 0; turn < 3 && taken[corners.x]; ++turn)
            corners = {corners.y, corners.z, corners.x};
        if (taken[corners.x]) {
            mesh.vertices_m.push_back(glm::vec3{mesh.vertices_m[corners.x]});
            corners.x = static_cast<std::uint32_t>(mesh.vertices_m.size() - 1);
            taken.push_back(false);
        }
        taken[corners.x] = true;
    }
}

/// Neighbours in the list stay together; what blocks share is doubled.
std::vector<Mesh> cut(const Mesh& mesh) {
    constexpr std::uint32_t nowhere = ~0U;
    std::vector<Mesh> blocks;
    std::vector<std::uint32_t> in_block(mesh.vertices_m.size(), nowhere);
    for (std::size_t begin = 0; begin < mesh.triangles.size(); begin += block_size) {
        const auto triangles = std::span{mesh.triangles}.subspan(
            begin, std::min(block_size, mesh.triangles.size() - begin));
        Mesh& block = blocks.emplace_back();
        for (glm::uvec3 corners : triangles) {
            for (int i = 0; i < 3; ++i) {
                std::uint32_t& place = in_block[corners[i]];
                if (place == nowhere) {
                    place = static_cast<std::uint32_t>(block.vertices_m.size());
                    block.vertices_m.push_back(mesh.vertices_m[corners[i]]);
                }
                corners[i] = place;
            }
            block.triangles.push_back(corners);
        }
        for (const glm::uvec3& corners : triangles) {
            for (int i = 0; i < 3; ++i)
                in_block[corners[i]] = nowhere;
        }
    }
    return blocks;
}

}  // namespace

std::vector<Mesh> in_blocks(Mesh mesh) {
    if (mesh.triangles.size() > block_size) order_by_place(mesh);
    std::vector<Mesh> blocks = cut(mesh);
    std::ranges::for_each(blocks, give_first_corners);
    return blocks;
}

}  // namespace scipd::sim
