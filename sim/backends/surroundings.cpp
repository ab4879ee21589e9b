// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/surroundings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/backends/intersect.h"
#include "sim/world/bounds.h"

namespace scipd::sim {
namespace {

/// What stands on a face may be in it by so much.
constexpr double margin_m = 0.001;
constexpr double least_below_m = 0.005;

/// Some object where it is, and a box around it.
struct PlacedObject {
    const Object* object;
    Pose world_from_object;
    Bounds bounds;  ///< in the frame of the object
};

ObjectId id_of(const Scene& scene, const PlacedObject& placed) {
    return static_cast<ObjectId>(placed.object - scene.objects.data());
}

/// Shapes that are not empty and are seen.
std::vector<PlacedObject> all_placed(const Scene& scene, std::span<const Pose> world_from_model,
                                     const Unseen& unseen) {
    std::vector<PlacedObject> all;
    for (const Object& object : scene.objects) {
        const auto id = static_cast<ObjectId>(&object - scene.objects.data());
        if (object.model == unseen.model || unseen.has(id)) continue;
        const Bounds bounds = bounds_of(object.shape);
        if (bounds.empty()) continue;
        all.push_back({&object, world_from_model[object.model] * object.model_from_object, bounds});
    }
    return all;
}

Ray ray_in(const PlacedObject& placed, const Ray& ray) {
    const Pose object_from_world = inverse(placed.world_from_object);
    return {object_from_world * ray.origin_m, object_from_world.rotation * ray.direction};
}

/// `range_m` is infinite where it is not met.
Crossing meet(const PlacedObject& placed, const Ray& ray) {
    const Ray local = ray_in(placed, ray);
    const Box around{placed.bounds.high_m - placed.bounds.low_m + 2 * margin_m};
    const Ray from_middle{local.origin_m - placed.bounds.middle_m(), local.direction};
    if (std::isinf(intersect(from_middle, around).range_m)) return {};
    return intersect(local, placed.object->shape);
}

bool meets_any(const std::vector<PlacedObject>& all, const Ray& ray) {
    return std::ranges::any_of(
        all, [&](const PlacedObject& placed) { return !std::isinf(meet(placed, ray).range_m); });
}

// Within something solid.

/// Whether a point lies deep enough in what is round or has corners.
struct InPrimitive {
    const glm::dvec3& at_m;

    bool operator()(const Box& box) const {
        const glm::dvec3 depth_m = 0.5 * box.size_m - glm::abs(at_m);
        return std::min({depth_m.x, depth_m.y, depth_m.z}) > margin_m;
    }
    bool operator()(const Cylinder& cylinder) const {
        return std::hypot(at_m.x, at_m.y) < cylinder.radius_m - margin_m &&
               std::abs(at_m.z) < 0.5 * cylinder.length_m - margin_m;
    }
    bool operator()(const Sphere& sphere) const {
        return glm::length(at_m) < sphere.radius_m - margin_m;
    }
    bool operator()(const Plane&) const { return false; }
    bool operator()(const SharedMesh&) const { return false; }
};

/// What a ray goes through of a mesh, or of several.
struct Passage {
    int faces = 0;
    double nearest_m = std::numeric_limits<double>::infinity();
    bool nearest_is_back = false;

    void add(const std::optional<Piercing>& piercing) {
        if (!piercing) return;
        ++faces;
        if (piercing->range_m > nearest_m) return;
        nearest_m = piercing->range_m;
        nearest_is_back = piercing->is_back;
    }
};

/// Along no edge that anybody has drawn; down and up first, where what is open mostly is.
constexpr std::array<glm::dvec3, 10> outwards{{{0.0123, 0.0271, -0.9996},
                                               {-0.0217, 0.0119, 0.9997},
                                               {0.9994, 0.0291, 0.0183},
                                               {-0.9995, -0.0157, 0.0269},
                                               {0.0253, 0.9995, -0.0179},
                                               {-0.0199, -0.9996, -0.0213},
                                               {0.5713, 0.5837, 0.5770},
                                               {-0.5791, 0.5719, -0.5810},
                                               {0.5869, -0.5731, -0.5719},
                                               {-0.5761, -0.5783, 0.5776}}};

using Parts = std::span<const PlacedObject>;

/// Meshes that follow each other at the same place are the materials of one.
bool in_meshes(Parts parts, const glm::dvec3& at_m) {
    return std::ranges::all_of(outwards, [&](const glm::dvec3& direction) {
        Passage passage;
        const Ray ray{at_m, glm::normalize(direction)};
        for (const PlacedObject& part : parts) {
            const Mesh& mesh = *std::get<SharedMesh>(part.object->shape);
            for (const glm::uvec3& triangle : mesh.triangles) {
                passage.add(pierce(ray, mesh.vertices_m[triangle.x], mesh.vertices_m[triangle.y],
                                   mesh.vertices_m[triangle.z]));
            }
        }
        return passage.faces % 2 == 1 && passage.nearest_is_back && passage.nearest_m > margin_m;
    });
}

bool is_mesh(const PlacedObject& placed) {
    return std::holds_alternative<SharedMesh>(placed.object->shape);
}

/// The first, and those that are one thing with it.
Parts first_thing(Parts all) {
    const PlacedObject& first = all.front();
    const auto end = std::ranges::find_if(all, [&](const PlacedObject& next) {
        return &next != &first &&
               (!is_mesh(first) || !is_mesh(next) || next.object->model != first.object->model ||
                next.object->model_from_object != first.object->model_from_object);
    });
    return {all.begin(), end};
}

/// True if a point of the thing's own frame lies in the box around it, or so close to that.
bool is_near(Parts thing, const glm::dvec3& at_m, double outside_m = 0.0) {
    Bounds around;
    for (const PlacedObject& part : thing)
        around.include(part.bounds, {});
    return glm::all(glm::lessThan(around.low_m - outside_m, at_m)) &&
           glm::all(glm::lessThan(at_m, around.high_m + outside_m));
}

bool is_inside(Parts thing, const glm::dvec3& world_at_m) {
    const glm::dvec3 at_m = inverse(thing.front().world_from_object) * world_at_m;
    if (!is_near(thing, at_m)) return false;
    if (is_mesh(thing.front())) return in_meshes(thing, at_m);
    return std::visit(InPrimitive{at_m}, thing.front().object->shape);
}

// The housing of a sensor.

/// The median range of rays to a thing that the sensor is within; infinity where it is not, or most
/// rays do not meet it. A few rays are enough.
double shell_radius_m(Parts thing, const Pose& model_from_sensor,
                      std::span<const glm::vec3> directions) {
    const glm::dvec3& at_m = model_from_sensor.translation_m;
    const glm::dvec3 in_thing_m = inverse(thing.front().world_from_object) * at_m;
    std::vector<double> ranges_m;
    if (!is_near(thing, in_thing_m, margin_m)) return std::numeric_limits<double>::infinity();
    constexpr std::size_t enough = 48;
    const std::size_t step = std::max<std::size_t>(1, directions.size() / enough);
    for (std::size_t i = 0; i < directions.size(); i += step) {
        const Ray ray{at_m, model_from_sensor.rotation * glm::dvec3{directions[i]}};
        double& range_m = ranges_m.emplace_back(std::numeric_limits<double>::infinity());
        for (const PlacedObject& part : thing)
            range_m = std::min(range_m, intersect(ray_in(part, ray), part.object->shape).range_m);
    }
    std::ranges::nth_element(ranges_m, ranges_m.begin() + ranges_m.size() / 2);
    return ranges_m[ranges_m.size() / 2];
}

// Below the ground.

/// A floor is so large, and a shelf is not.
bool is_like_ground(const PlacedObject& placed) {
    if (const auto* plane = std::get_if<Plane>(&placed.object->shape)) {
        constexpr double least_m = 5.0;
        const glm::dvec3 normal = placed.world_from_object.rotation * glm::dvec3{0, 0, 1};
        return normal.z > 0.7 && std::min(plane->size_m.x, plane->size_m.y) >= least_m;
    }
    constexpr double least_m = 10.0;
    Bounds bounds;
    bounds.include(placed.bounds, placed.world_from_object);
    const glm::dvec3 size_m = bounds.high_m - bounds.low_m;
    return std::min(size_m.x, size_m.y) >= least_m;
}

/// A ceiling has walls below it.
bool sees_anything_below(const std::vector<PlacedObject>& all, const glm::dvec3& at_m) {
    constexpr int headings = 8;
    for (int i = 0; i < headings; ++i) {
        const double heading_rad = 2 * std::numbers::pi * (i + 0.13) / headings;
        for (const double slope : {0.02, 0.2, 1.0}) {
            const glm::dvec3 down{std::cos(heading_rad), std::sin(heading_rad), -slope};
            if (meets_any(all, {at_m, glm::normalize(down)})) return true;
        }
    }
    return false;
}

std::optional<OddPlace> below_ground(const Scene& scene, const std::vector<PlacedObject>& all,
                                     const glm::dvec3& at_m) {
    const PlacedObject* above = nullptr;
    double above_m = std::numeric_limits<double>::infinity();
    for (const PlacedObject& placed : all) {
        const double range_m = meet(placed, {at_m, {0, 0, 1}}).range_m;
        if (range_m >= above_m) continue;
        above = &placed;
        above_m = range_m;
    }
    if (above == nullptr || above_m < least_below_m || !is_like_ground(*above)) return {};
    if (meets_any(all, {at_m, {0, 0, -1}})) return {};
    const bool says_which_side = std::holds_alternative<Plane>(above->object->shape);
    if (!says_which_side && sees_anything_below(all, at_m)) return {};
    return OddPlace{OddPlace::Kind::below, id_of(scene, *above)};
}

}  // namespace

std::optional<OddPlace> odd_place(const Scene& scene, std::span<const Pose> world_from_model,
                                  const glm::dvec3& at_m, const Unseen& unseen) {
    const std::vector<PlacedObject> all = all_placed(scene, world_from_model, unseen);
    for (Parts rest = all; !rest.empty();) {
        const Parts thing = first_thing(rest);
        if (is_inside(thing, at_m)) {
            return OddPlace{OddPlace::Kind::inside, id_of(scene, thing.front())};
        }
        rest = rest.subspan(thing.size());
    }
    return below_ground(scene, all, at_m);
}

std::vector<ObjectId> housing_of(const Scene& scene, ModelId carrier, const std::string& link,
                                 const Pose& model_from_sensor,
                                 std::span<const glm::vec3> directions) {
    // Large scanners are 0.16 m wide.
    constexpr double reach_m = 0.3;
    constexpr double reach_of_others_m = 0.15;
    std::vector<PlacedObject> parts;
    for (const Object& object : scene.objects) {
        if (object.model != carrier) continue;
        const Bounds bounds = bounds_of(object.shape);
        if (!bounds.empty()) parts.push_back({&object, object.model_from_object, bounds});
    }
    std::vector<ObjectId> own;
    std::vector<ObjectId> closest;
    double closest_m = reach_of_others_m;
    for (Parts rest = parts; !rest.empty();) {
        const Parts thing = first_thing(rest);
        rest = rest.subspan(thing.size());
        const std::string_view name = thing.front().object->name;
        const bool is_own = name.substr(0, name.rfind("::")) == link;
        const double radius_m = shell_radius_m(thing, model_from_sensor, directions);
        if (radius_m > (is_own ? reach_m : closest_m)) continue;
        if (!is_own) closest.clear();
        if (!is_own) closest_m = radius_m;
        for (const PlacedObject& part : thing)
            (is_own ? own : closest).push_back(id_of(scene, part));
    }
    return own.empty() ? closest : own;
}

}  // namespace scipd::sim
