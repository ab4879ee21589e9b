// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/light_path.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <glm/geometric.hpp>

namespace scipd::sim {
namespace {

/// Rays begin so far behind the face that they come from, so that they do not meet it again.
constexpr double behind_face_m = 1e-3;

/// Light on its way from a face.
struct Leg {
    std::uint32_t ray;
    float share;   ///< of the light that will be left when it has come back
    float gone_m;  ///< from the sensor to the face
    glm::dvec3 from_m;
    glm::dvec3 direction;
};

class Legs {
  public:
    Legs(const LitWorld& lit, float max_range_m) : lit_(&lit), max_range_m_(max_range_m) {}

    [[nodiscard]] bool empty() const { return legs_.empty(); }
    [[nodiscard]] std::span<const Leg> all() const { return legs_; }

    /// The light goes on from what this leg has met.
    void go_on(const Leg& leg, const Hit& hit, const glm::dvec3& normal) {
        if (!hit.met()) return;
        const Reflection& material = lit_->of(hit.material);
        const glm::dvec3 at_m = leg.from_m + double{hit.range_m} * leg.direction;
        add(leg, hit, material.surface().transmission, at_m, leg.direction);
        const glm::dvec3 mirrored = leg.direction - 2.0 * glm::dot(leg.direction, normal) * normal;
        add(leg, hit, material.mirrored(), at_m, mirrored);
    }

    /// All next legs as one fan, which is valid until more are added.
    [[nodiscard]] Fan fan() {
        poses_.clear();
        directions_.clear();
        for (const Leg& leg : legs_) {
            poses_.push_back({.translation_m = leg.from_m});
            directions_.emplace_back(leg.direction);
        }
        return {
            .directions = directions_, .world_from_sensor = poses_, .max_range_m = max_range_m_};
    }

  private:
    // The light passes the face on its way back too.
    void add(const Leg& leg, const Hit& hit, float passed, const glm::dvec3& at_m,
             const glm::dvec3& direction) {
        const float share = leg.share * passed * passed;
        const float gone_m = leg.gone_m + hit.range_m + float(behind_face_m);
        if (passed < least_share || share < least_share || gone_m >= max_range_m_) return;
        legs_.push_back({leg.ray, share, gone_m, at_m + behind_face_m * direction, direction});
    }

    const LitWorld* lit_;
    float max_range_m_;
    std::vector<Leg> legs_;
    std::vector<Pose> poses_;
    std::vector<glm::vec3> directions_;
};

/// The light that leaves the sensor, as far as it goes on from its first hit.
Legs first_legs(const Fan& fan, const LitWorld& lit, std::span<const Hit> hits,
                std::span<const glm::vec3> world_normals) {
    Legs legs(lit, fan.max_range_m);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (!hits[i].met()) continue;
        const Reflection& material = lit.of(hits[i].material);
        if (material.surface().transmission < least_share && material.mirrored() < least_share)
            continue;
        const Pose& pose = fan.world_from_sensor[fan.pose_index(i)];
        const glm::dvec3 direction = pose.rotation * glm::dvec3{fan.directions[i]};
        legs.go_on({static_cast<std::uint32_t>(i), 1.0F, 0.0F, pose.translation_m, direction},
                   hits[i], glm::dvec3{world_normals[i]});
    }
    return legs;
}

}  // namespace

void follow_light(RangeBackend& backend, const Fan& fan, const LitWorld& lit,
                  std::uint32_t first_ray, std::span<const Hit> hits,
                  std::span<const glm::vec3> world_normals, std::vector<FartherHit>& farther) {
    const auto before = static_cast<std::ptrdiff_t>(farther.size());
    std::vector<Hit> next;
    std::vector<glm::vec3> normals;
    Legs legs = first_legs(fan, lit, hits, world_normals);
    for (int passed = 0; passed < most_faces_passed && !legs.empty(); ++passed) {
        next.resize(legs.all().size());
        normals.resize(legs.all().size());
        backend.cast(legs.fan(), next, normals);
        Legs further(lit, fan.max_range_m);
        for (std::size_t i = 0; i < next.size(); ++i) {
            const Leg& leg = legs.all()[i];
            further.go_on(leg, next[i], glm::dvec3{normals[i]});
            Hit hit = next[i];
            hit.range_m += leg.gone_m;
            if (!hit.met() || hit.range_m > fan.max_range_m) continue;
            const glm::dvec3 at_m = leg.from_m + double{next[i].range_m} * leg.direction;
            farther.push_back({first_ray + leg.ray, leg.share, hit, at_m});
        }
        std::swap(legs, further);
    }
    std::ranges::stable_sort(farther.begin() + before, farther.end(), {}, &FartherHit::ray);
}

}  // namespace scipd::sim
