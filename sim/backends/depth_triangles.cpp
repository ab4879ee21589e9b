// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/depth_triangles.h"

#include <algorithm>
#include <bit>
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

}  // namespace

Frustum::Frustum(const Strip& strip, const Pose& anchored_from_sensor)
    : eye_m(anchored_from_sensor.translation_m) {
    const glm::dvec2 low = strip.first - 0.5 * strip.pitch;
    const glm::dvec2 high = low + strip.pitch * glm::dvec2{strip.size_px};
    const std::array<glm::dvec3, 5> in_sensor{
        strip.left - low.x * strip.forward, high.x * strip.forward - strip.left,
        strip.up - low.y * strip.forward, high.y * strip.forward - strip.up, strip.forward};
    std::ranges::transform(in_sensor, inward.begin(), [&](const glm::dvec3& normal) {
        return glm::vec3{anchored_from_sensor.rotation * normal};
    });
    std::ranges::transform(inward, reach.begin(),
                           [](const glm::vec3& normal) { return glm::abs(normal); });
}

std::optional<unsigned> Frustum::sides_through(const glm::vec3& middle_m,
                                               const glm::vec3& half_m) const {
    unsigned through = 0;
    for (std::size_t side = 0; side < inward.size(); ++side) {
        const float inside_m = glm::dot(inward[side], middle_m);
        const float reach_m = glm::dot(reach[side], half_m);
        if (inside_m + reach_m < 0.0F) return std::nullopt;
        if (inside_m - reach_m < 0.0F) through |= 1U << side;
    }
    return through;
}

bool Frustum::beyond(unsigned sides, const std::array<glm::vec3, 3>& triangle_m) const {
    for (; sides != 0; sides &= sides - 1) {
        const glm::vec3& normal = inward[static_cast<std::size_t>(std::countr_zero(sides))];
        const float a_m = glm::dot(normal, triangle_m[0]);
        const float b_m = glm::dot(normal, triangle_m[1]);
        const float c_m = glm::dot(normal, triangle_m[2]);
        if (std::max({a_m, b_m, c_m}) < -rounding_m) return true;
    }
    return false;
}

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
    give_first_corners(mesh);

    const auto first_vertex = static_cast<std::uint32_t>(vertices_.size());
    const std::size_t first = triangles_.size();
    for (const glm::vec3& vertex : mesh.vertices_m)
        vertices_.push_back({anchored_from_object * glm::dvec3{vertex}, 0});
    for (const glm::uvec3& corners : mesh.triangles) {
        vertices_[first_vertex + corners.x].triangle = static_cast<TriangleId>(triangles_.size());
        triangles_.push_back({first_vertex + corners});
    }
    const std::size_t end = triangles_.size();
    faces_.resize(end, Face{.object = id});
    Body& body = bodies_.emplace_back(Body{object.model, block(first, end - first), {}, solid});
    turn_faces(body.all);
    for (std::size_t begin = first; end - first > part_size && begin < end; begin += part_size)
        body.parts.push_back(block(begin, std::min(part_size, end - begin)));
    if (!movable) return;
    movables_.push_back({object.model, object.model_from_object, std::move(mesh.vertices_m),
                         first_vertex, bodies_.size() - 1});
}

DepthTriangles::Block DepthTriangles::block(std::size_t first, std::size_t count) const {
    Block block{{}, {}, static_cast<TriangleId>(first), static_cast<std::uint32_t>(count)};
    enclose(block);
    return block;
}

void DepthTriangles::enclose(Block& block) const {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high = -low;
    for (const DrawnTriangle& triangle : std::span{triangles_}.subspan(block.first, block.count)) {
        for (int i = 0; i < 3; ++i) {
            low = glm::min(low, vertices_[triangle.corners[i]].position_m);
            high = glm::max(high, vertices_[triangle.corners[i]].position_m);
        }
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
        turn_faces(bodies_[movable.body].all);
        std::ranges::for_each(bodies_[movable.body].parts, [&](Block& part) { enclose(part); });
        first = std::min<std::size_t>(first, movable.first_vertex);
        end = std::max(end, movable.first_vertex + movable.in_object_m.size());
    }
    return first < end ? VertexRange{first, end - first} : VertexRange{};
}

void DepthTriangles::collect(const Frustum& frustum, ModelId unseen,
                             std::vector<DrawnTriangle>& drawn) const {
    struct Seen {
        float distance;
        unsigned sides;
        const Body* body;
    };
    std::vector<Seen> seen;
    for (const Body& body : bodies_) {
        if (body.model == unseen) continue;
        const glm::vec3 middle_m = body.all.middle_m - frustum.eye_m;
        if (const auto sides = frustum.sides_through(middle_m, body.all.half_m))
            seen.push_back({glm::dot(middle_m, middle_m), *sides, &body});
    }
    std::ranges::sort(seen, {}, &Seen::distance);
    for (const auto& [distance, sides, body] : seen) {
        const glm::vec3 off_m = glm::abs(body->all.middle_m - frustum.eye_m) - body->all.half_m;
        const bool hides_back = body->solid && std::max({off_m.x, off_m.y, off_m.z}) > 0.0F;
        if (body->parts.empty()) collect(body->all, hides_back, sides, frustum, drawn);
        for (const Block& part : body->parts) {
            const glm::vec3 middle_m = part.middle_m - frustum.eye_m;
            if (const auto through = frustum.sides_through(middle_m, part.half_m))
                collect(part, hides_back, *through, frustum, drawn);
        }
    }
}

void DepthTriangles::collect(const Block& block, bool hides_back, unsigned sides,
                             const Frustum& frustum, std::vector<DrawnTriangle>& drawn) const {
    for (TriangleId id = block.first; id < block.first + block.count; ++id) {
        const DrawnTriangle& triangle = triangles_[id];
        const glm::vec3 a = vertices_[triangle.corners.x].position_m - frustum.eye_m;
        if (hides_back && glm::dot(faces_[id].normal, a) > 0.0F) continue;
        const glm::vec3 b = vertices_[triangle.corners.y].position_m - frustum.eye_m;
        const glm::vec3 c = vertices_[triangle.corners.z].position_m - frustum.eye_m;
        if (!frustum.beyond(sides, {a, b, c})) drawn.push_back(triangle);
    }
}

}  // namespace scipd::sim
