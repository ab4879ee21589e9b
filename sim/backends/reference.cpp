// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/reference.h"

#include <cmath>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "sim/backends/intersect.h"
#include "sim/world/bounds.h"

namespace scipd::sim {
namespace {

/// One object of the scene, where it is now, and a sphere around it.
struct Placed {
    const Object* object;
    Pose world_from_object;
    glm::dvec3 middle_in_object_m;
    double radius_m;
};

Placed placed(const Scene& scene, const Object& object) {
    const Bounds bounds = bounds_of(object.shape);
    const bool nothing = bounds.empty();
    return {&object, scene.models[object.model].world_from_model * object.model_from_object,
            nothing ? glm::dvec3{0.0} : bounds.middle_m(),
            nothing ? 0.0 : 0.5 * glm::length(bounds.high_m - bounds.low_m)};
}

/// Whether any of the object can lie on the ray and no farther than `range_m`.
bool within_reach(const Ray& ray, const Placed& placed, double range_m) {
    const glm::dvec3 to_middle =
        placed.world_from_object * placed.middle_in_object_m - ray.origin_m;
    const double along_m = glm::dot(to_middle, ray.direction);
    if (along_m < -placed.radius_m || along_m - placed.radius_m > range_m) return false;
    const double slack = 1.0 + 1e-9;  // a corner may lie on the sphere
    const double squared = placed.radius_m * placed.radius_m * slack + 1e-12;
    return glm::dot(to_middle, to_middle) - along_m * along_m <= squared;
}

class ReferenceBackend final : public RangeBackend {
  public:
    explicit ReferenceBackend(SharedScene shared_scene) : RangeBackend(std::move(shared_scene)) {
        for (const Object& object : scene().objects)
            objects_.push_back(placed(scene(), object));
    }

  private:
    void do_move(ModelId model, const Pose& world_from_model) override {
        for (Placed& placed : objects_) {
            if (placed.object->model != model) continue;
            placed.world_from_object = world_from_model * placed.object->model_from_object;
        }
    }

    void do_cast(const Fan& fan, std::span<Hit> hits) override {
        for (std::size_t i = 0; i < hits.size(); ++i)
            hits[i] = first_hit(ray_of(fan, i), fan.max_range_m, fan.unseen).hit;
    }

    [[nodiscard]] bool follows_light() const override { return true; }
    void do_cast_with_normals(const Fan& fan, std::span<Hit> hits,
                              std::span<glm::vec3> world_normals) override {
        for (std::size_t i = 0; i < hits.size(); ++i) {
            const Met met = first_hit(ray_of(fan, i), fan.max_range_m, fan.unseen);
            hits[i] = met.hit;
            world_normals[i] = glm::vec3{met.world_normal};
        }
    }

    static Ray ray_of(const Fan& fan, std::size_t i) {
        const Pose& pose = fan.world_from_sensor[fan.pose_index(i)];
        return {pose.translation_m, pose.rotation * glm::dvec3{fan.directions[i]}};
    }

    struct Met {
        Hit hit;
        glm::dvec3 world_normal{0.0};
    };

    [[nodiscard]] Met first_hit(const Ray& ray, double max_range_m, const Unseen& unseen) const {
        Met met;
        Hit& hit = met.hit;
        double nearest_m = max_range_m;
        for (const Placed& placed : objects_) {
            const auto id = static_cast<ObjectId>(placed.object - scene().objects.data());
            if (placed.object->model == unseen.model || unseen.has(id)) continue;
            if (!within_reach(ray, placed, nearest_m)) continue;
            const Pose object_from_world = inverse(placed.world_from_object);
            const Ray local{object_from_world * ray.origin_m,
                            object_from_world.rotation * ray.direction};
            const Crossing crossing = intersect(local, placed.object->shape);
            if (std::isinf(crossing.range_m) || crossing.range_m > nearest_m) continue;
            if (hit.met() && crossing.range_m == nearest_m) continue;
            nearest_m = crossing.range_m;
            hit.range_m = static_cast<float>(crossing.range_m);
            hit.cos_incidence =
                static_cast<float>(std::abs(glm::dot(local.direction, crossing.normal)));
            met.world_normal = placed.world_from_object.rotation * crossing.normal;
            hit.material = placed.object->material;
            hit.object = id;
        }
        return met;
    }

    std::vector<Placed> objects_;
};

}  // namespace

std::string_view reference_description() {
    return "exact and slow: every ray against every object in double precision";
}

std::unique_ptr<RangeBackend> make_reference_backend(SharedScene scene) {
    return std::make_unique<ReferenceBackend>(std::move(scene));
}

}  // namespace scipd::sim
