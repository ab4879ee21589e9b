// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/depth_triangles.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/world/shape.h"

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

/// A mesh as the depth backend draws it: in blocks of 64 neighbouring triangles, the last of fewer,
/// so that a picture can leave most of a large one out, and each triangle begins with a corner that
/// no other of its block begins with, so that this corner can carry its number. Corners that blocks
/// share are doubled.
std::vector<Mesh> in_blocks(Mesh mesh) {
    if (mesh.triangles.size() > block_size) order_by_place(mesh);
    std::vector<Mesh> blocks = cut(mesh);
    std::ranges::for_each(blocks, give_first_corners);
    return blocks;
}

/// Blocks of a mesh of many thousands of triangles: most are left out by their cluster.
constexpr std::size_t cluster_size = 64;

/// More than floats may be off in a world of a kilometre.
constexpr float rounding_m = 1e-3F;

/// For convex shapes around their origin: corners go counter-clockwise, seen from outside.
void turn_outward(Mesh& mesh) {
    for (glm::uvec3& corners : mesh.triangles) {
        const glm::vec3& a = mesh.vertices_m[corners.x];
        const glm::vec3& b = mesh.vertices_m[corners.y];
        const glm::vec3& c = mesh.vertices_m[corners.z];
        if (glm::dot(glm::cross(b - a, c - a), a + b + c) < 0.0F) std::swap(corners.y, corners.z);
    }
}

CentredBox between(const glm::vec3& low, const glm::vec3& high) {
    return {0.5F * (low + high), 0.5F * (high - low)};
}

std::vector<Cluster> clustered(const std::vector<Block>& blocks) {
    std::vector<Cluster> clusters;
    for (std::size_t first = 0; first < blocks.size(); first += cluster_size) {
        const std::size_t count = std::min(cluster_size, blocks.size() - first);
        glm::vec3 low{std::numeric_limits<float>::max()};
        glm::vec3 high = -low;
        for (const Block& block : std::span{blocks}.subspan(first, count)) {
            low = glm::min(low, block.bounds.middle_m - block.bounds.half_m);
            high = glm::max(high, block.bounds.middle_m + block.bounds.half_m);
        }
        clusters.push_back({between(low, high), first, count});
    }
    return clusters;
}

}  // namespace

DepthTriangles::DepthTriangles(const Scene& scene) {
    const Pose anchored_from_world{-scene.anchor_m, Pose{}.rotation};
    for (ObjectId id = 0; id < scene.objects.size(); ++id) {
        const Object& object = scene.objects[id];
        const Model& model = scene.models[object.model];
        add(id, object, model.movable,
            anchored_from_world * model.world_from_model * object.model_from_object);
    }
    std::ranges::stable_sort(movables_, {}, &Movable::model);
}

void DepthTriangles::add(ObjectId id, const Object& object, bool movable,
                         const Pose& anchored_from_object) {
    Mesh mesh = tessellate(object.shape);
    if (mesh.triangles.empty()) return;
    const bool solid = !std::holds_alternative<Plane>(object.shape) &&
                       !std::holds_alternative<SharedMesh>(object.shape);
    if (solid) turn_outward(mesh);

    const auto first_vertex = static_cast<std::uint32_t>(vertices_.size());
    const auto first = static_cast<TriangleId>(triangles_.size());
    std::vector<glm::vec3> in_object_m;
    std::vector<Block> blocks;
    for (const Mesh& part : in_blocks(std::move(mesh))) {
        const auto block_vertex = static_cast<std::uint32_t>(vertices_.size());
        const auto block_first = static_cast<TriangleId>(triangles_.size());
        for (const glm::vec3& vertex : part.vertices_m)
            vertices_.push_back({anchored_from_object * glm::dvec3{vertex}, 0});
        for (const glm::uvec3& corners : part.triangles) {
            vertices_[block_vertex + corners.x].triangle =
                static_cast<TriangleId>(triangles_.size());
            triangles_.push_back({block_vertex + corners});
        }
        blocks.push_back(block_from(block_first, block_vertex));
        if (movable) std::ranges::copy(part.vertices_m, std::back_inserter(in_object_m));
    }
    faces_.resize(triangles_.size(), Face{.object = id});
    const Block all = block_from(first, first_vertex);
    turn_faces(all);
    std::vector<Cluster> clusters = clustered(blocks);
    bodies_.push_back({object.model, all, std::move(blocks), std::move(clusters), solid});
    middles_m_.emplace_back(all.bounds.middle_m, 0.0F);
    halves_m_.emplace_back(all.bounds.half_m, 0.0F);
    if (!movable) return;
    movables_.push_back({object.model, object.model_from_object, std::move(in_object_m),
                         first_vertex, bodies_.size() - 1});
}

const Body& DepthTriangles::body_of(TriangleId triangle) const {
    const auto next = std::ranges::upper_bound(bodies_, triangle, {},
                                               [](const Body& body) { return body.all.first; });
    return *std::prev(next);
}

/// What was added since then.
Block DepthTriangles::block_from(TriangleId first, std::uint32_t first_vertex) const {
    Block block{{},
                first,
                static_cast<std::uint32_t>(triangles_.size() - first),
                first_vertex,
                static_cast<std::uint32_t>(vertices_.size() - first_vertex)};
    block.bounds = bounds_of(block);
    return block;
}

CentredBox DepthTriangles::bounds_of(const Block& block) const {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high = -low;
    for (const DrawnVertex& vertex :
         std::span{vertices_}.subspan(block.first_vertex, block.vertex_count)) {
        low = glm::min(low, vertex.position_m);
        high = glm::max(high, vertex.position_m);
    }
    return between(low - rounding_m, high + rounding_m);
}

void DepthTriangles::turn_faces(const Block& block) {
    for (TriangleId id = block.first; id < block.first + block.count; ++id) {
        const glm::uvec3 corners = triangles_[id].corners;
        const glm::dvec3 a{vertices_[corners.x].position_m};
        const glm::dvec3 b{vertices_[corners.y].position_m};
        const glm::dvec3 c{vertices_[corners.z].position_m};
        faces_[id].normal = glm::normalize(glm::cross(b - a, c - a));
    }
}

VertexRange DepthTriangles::move(ModelId model, const Pose& anchored_from_model) {
    std::size_t first = vertices_.size();
    std::size_t end = 0;
    auto movable = std::ranges::lower_bound(movables_, model, {}, &Movable::model);
    for (; movable != movables_.end() && movable->model == model; ++movable) {
        const Pose anchored_from_object = anchored_from_model * movable->model_from_object;
        for (std::size_t i = 0; i < movable->in_object_m.size(); ++i) {
            vertices_[movable->first_vertex + i].position_m =
                anchored_from_object * glm::dvec3{movable->in_object_m[i]};
        }
        Body& body = bodies_[movable->body];
        for (Block& block : body.blocks)
            block.bounds = bounds_of(block);
        body.clusters = clustered(body.blocks);
        body.all.bounds = bounds_of(body.all);
        middles_m_[movable->body] = glm::vec4{body.all.bounds.middle_m, 0.0F};
        halves_m_[movable->body] = glm::vec4{body.all.bounds.half_m, 0.0F};
        turn_faces(body.all);
        first = std::min<std::size_t>(first, movable->first_vertex);
        end = std::max(end, movable->first_vertex + movable->in_object_m.size());
    }
    return first < end ? VertexRange{first, end - first} : VertexRange{};
}

void DepthTriangles::collect(const Frustum& frustum, const Unseen& unseen,
                             std::vector<DrawnTriangle>& drawn) {
    missed_.resize(bodies_.size());
    const glm::vec3 eye_m = frustum.eye_m();
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        missed_[i] = frustum.misses(glm::vec3{middles_m_[i]} - eye_m, glm::vec3{halves_m_[i]});
    seen_.clear();
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (missed_[i] != 0 || bodies_[i].model == unseen.model) continue;
        if (unseen.has(faces_[bodies_[i].all.first].object)) continue;
        const glm::vec3 middle_m = glm::vec3{middles_m_[i]} - eye_m;
        seen_.push_back({glm::dot(middle_m, middle_m),
                         frustum.place_of(middle_m, glm::vec3{halves_m_[i]}), &bodies_[i]});
    }
    std::ranges::sort(seen_, {}, &Seen::distance);
    for (const auto& [distance, place, body] : seen_)
        collect(*body, place, frustum, drawn);
}

void DepthTriangles::collect(const Body& body, Frustum::Place place, const Frustum& frustum,
                             std::vector<DrawnTriangle>& drawn) {
    const glm::vec3 eye_m = frustum.eye_m();
    const auto place_of = [&](const CentredBox& bounds) {
        return frustum.place_of(bounds.middle_m - eye_m, bounds.half_m);
    };
    const CentredBox& bounds = body.all.bounds;
    const glm::vec3 off_m = glm::abs(bounds.middle_m - eye_m) - bounds.half_m;
    const bool hides_back = body.solid && std::max({off_m.x, off_m.y, off_m.z}) > 0.0F;
    if (body.blocks.size() == 1)
        return collect(body.blocks.front(), place, hides_back, frustum, drawn);
    for (const Cluster& cluster : body.clusters) {
        if (place_of(cluster.bounds) == Frustum::Place::beyond) continue;
        for (const Block& block : body.of(cluster)) {
            const auto block_place = place_of(block.bounds);
            if (block_place != Frustum::Place::beyond)
                collect(block, block_place, hides_back, frustum, drawn);
        }
    }
}

void DepthTriangles::collect(const Block& block, Frustum::Place place, bool hides_back,
                             const Frustum& frustum, std::vector<DrawnTriangle>& drawn) {
    const auto triangles = std::span{triangles_}.subspan(block.first, block.count);
    if (place == Frustum::Place::inside && !hides_back) {
        drawn.insert(drawn.end(), triangles.begin(), triangles.end());
        return;
    }
    const auto vertices = std::span{vertices_}.subspan(block.first_vertex, block.vertex_count);
    missed_.resize(vertices.size());
    const glm::vec3 eye_m = frustum.eye_m();
    for (std::size_t i = 0; i < vertices.size(); ++i)
        missed_[i] = frustum.sides_missed_by(vertices[i].position_m - eye_m);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const glm::uvec3 corners = triangles[i].corners - block.first_vertex;
        if ((missed_[corners.x] & missed_[corners.y] & missed_[corners.z]) != 0) continue;
        const glm::vec3 a = vertices[corners.x].position_m - eye_m;
        if (hides_back && glm::dot(faces_[block.first + i].normal, a) > 0.0F) continue;
        drawn.push_back(triangles[i]);
    }
}

}  // namespace scipd::sim
