// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/depth_triangles.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>
#include <variant>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace scipd::sim {
namespace {

/// Small enough to leave most of a big mesh out of a thin strip, large enough that few are looked
/// at.
constexpr std::size_t part_size = 64;
/// So many are looked through where a beam is at an edge of them, which takes microseconds.
constexpr std::size_t most_parts_around = 1024;

/// More than floats may be off in a world of a kilometre.
constexpr float rounding_m = 1e-3F;

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

/// For convex shapes around their origin: corners go counter-clockwise, seen from outside.
void turn_outward(Mesh& mesh) {
    for (glm::uvec3& corners : mesh.triangles) {
        const glm::vec3& a = mesh.vertices_m[corners.x];
        const glm::vec3& b = mesh.vertices_m[corners.y];
        const glm::vec3& c = mesh.vertices_m[corners.z];
        if (glm::dot(glm::cross(b - a, c - a), a + b + c) < 0.0F) std::swap(corners.y, corners.z);
    }
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

/// Neighbours in the list stay together; what parts share is doubled.
std::vector<Mesh> in_parts(const Mesh& mesh) {
    constexpr std::uint32_t nowhere = ~0U;
    std::vector<Mesh> parts;
    std::vector<std::uint32_t> in_part(mesh.vertices_m.size(), nowhere);
    for (std::size_t begin = 0; begin < mesh.triangles.size(); begin += part_size) {
        const auto triangles = std::span{mesh.triangles}.subspan(
            begin, std::min(part_size, mesh.triangles.size() - begin));
        Mesh& part = parts.emplace_back();
        for (glm::uvec3 corners : triangles) {
            for (int i = 0; i < 3; ++i) {
                std::uint32_t& place = in_part[corners[i]];
                if (place == nowhere) {
                    place = static_cast<std::uint32_t>(part.vertices_m.size());
                    part.vertices_m.push_back(mesh.vertices_m[corners[i]]);
                }
                corners[i] = place;
            }
            part.triangles.push_back(corners);
        }
        for (const glm::uvec3& corners : triangles) {
            for (int i = 0; i < 3; ++i)
                in_part[corners[i]] = nowhere;
        }
    }
    return parts;
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
    if (mesh.triangles.size() > part_size) order_by_place(mesh);

    const auto first_vertex = static_cast<std::uint32_t>(vertices_.size());
    const auto first = static_cast<TriangleId>(triangles_.size());
    std::vector<glm::vec3> in_object_m;
    std::vector<Block> parts;
    for (Mesh& part : in_parts(mesh)) {
        give_first_corners(part);
        const auto part_vertex = static_cast<std::uint32_t>(vertices_.size());
        const auto part_first = static_cast<TriangleId>(triangles_.size());
        for (const glm::vec3& vertex : part.vertices_m)
            vertices_.push_back({anchored_from_object * glm::dvec3{vertex}, 0});
        for (const glm::uvec3& corners : part.triangles) {
            vertices_[part_vertex + corners.x].triangle =
                static_cast<TriangleId>(triangles_.size());
            triangles_.push_back({part_vertex + corners});
        }
        parts.push_back(block_from(part_first, part_vertex));
        if (movable) std::ranges::copy(part.vertices_m, std::back_inserter(in_object_m));
    }
    faces_.resize(triangles_.size(), Face{.object = id});
    const Block all = block_from(first, first_vertex);
    turn_faces(all);
    if (parts.size() == 1) parts.clear();
    bodies_.push_back({object.model, all, std::move(parts), solid});
    middles_m_.emplace_back(all.middle_m, 0.0F);
    halves_m_.emplace_back(all.half_m, 0.0F);
    if (!movable) return;
    movables_.push_back({object.model, object.model_from_object, std::move(in_object_m),
                         first_vertex, bodies_.size() - 1});
}

std::span<const Block> DepthTriangles::around(TriangleId triangle) const {
    const auto next = std::ranges::upper_bound(bodies_, triangle, {},
                                               [](const Body& body) { return body.all.first; });
    const Body& body = *std::prev(next);
    if (body.parts.empty()) return {&body.all, 1};
    const std::size_t count = std::min(body.parts.size(), most_parts_around);
    const std::size_t part = (triangle - body.all.first) / part_size;
    const std::size_t before = std::min(part, most_parts_around / 2);
    return std::span{body.parts}.subspan(std::min(part - before, body.parts.size() - count), count);
}

/// What was added since then.
Block DepthTriangles::block_from(TriangleId first, std::uint32_t first_vertex) const {
    Block block{{},           {},
                first,        static_cast<std::uint32_t>(triangles_.size() - first),
                first_vertex, static_cast<std::uint32_t>(vertices_.size() - first_vertex)};
    enclose(block);
    return block;
}

void DepthTriangles::enclose(Block& block) const {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high = -low;
    for (const DrawnVertex& vertex :
         std::span{vertices_}.subspan(block.first_vertex, block.vertex_count)) {
        low = glm::min(low, vertex.position_m);
        high = glm::max(high, vertex.position_m);
    }
    block.middle_m = 0.5F * (low + high);
    block.half_m = 0.5F * (high - low) + rounding_m;
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
    for (const Movable& movable : std::ranges::equal_range(movables_, model, {}, &Movable::model)) {
        const Pose anchored_from_object = anchored_from_model * movable.model_from_object;
        for (std::size_t i = 0; i < movable.in_object_m.size(); ++i) {
            vertices_[movable.first_vertex + i].position_m =
                anchored_from_object * glm::dvec3{movable.in_object_m[i]};
        }
        enclose(bodies_[movable.body].all);
        middles_m_[movable.body] = glm::vec4{bodies_[movable.body].all.middle_m, 0.0F};
        halves_m_[movable.body] = glm::vec4{bodies_[movable.body].all.half_m, 0.0F};
        turn_faces(bodies_[movable.body].all);
        std::ranges::for_each(bodies_[movable.body].parts, [&](Block& part) { enclose(part); });
        first = std::min<std::size_t>(first, movable.first_vertex);
        end = std::max(end, movable.first_vertex + movable.in_object_m.size());
    }
    return first < end ? VertexRange{first, end - first} : VertexRange{};
}

void DepthTriangles::collect(const Frustum& frustum, ModelId unseen,
                             std::vector<DrawnTriangle>& drawn) {
    missed_.resize(bodies_.size());
    const glm::vec3 eye_m = frustum.eye_m();
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        missed_[i] = frustum.misses(glm::vec3{middles_m_[i]} - eye_m, glm::vec3{halves_m_[i]});
    seen_.clear();
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (missed_[i] != 0 || bodies_[i].model == unseen) continue;
        const glm::vec3 middle_m = glm::vec3{middles_m_[i]} - eye_m;
        seen_.push_back({glm::dot(middle_m, middle_m),
                         frustum.place_of(middle_m, glm::vec3{halves_m_[i]}), &bodies_[i]});
    }
    std::ranges::sort(seen_, {}, &Seen::distance);
    for (const auto& [distance, body_place, body] : seen_) {
        const glm::vec3 off_m = glm::abs(body->all.middle_m - frustum.eye_m()) - body->all.half_m;
        const bool hides_back = body->solid && std::max({off_m.x, off_m.y, off_m.z}) > 0.0F;
        if (body->parts.empty()) collect(body->all, body_place, hides_back, frustum, drawn);
        for (const Block& part : body->parts) {
            const auto place = frustum.place_of(part.middle_m - frustum.eye_m(), part.half_m);
            if (place != Frustum::Place::beyond) collect(part, place, hides_back, frustum, drawn);
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
