// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/depth_projection.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace scipd::sim {

Strip widened(const Strip& strip, const glm::ivec2& margin_px) {
    Strip wide = strip;
    wide.first -= strip.pitch * glm::dvec2{margin_px};
    wide.size_px += 2 * margin_px;
    return wide;
}

glm::dvec2 pixel_of(const Strip& strip, const glm::dvec3& direction) {
    const glm::dvec2 aside{glm::dot(strip.left, direction), glm::dot(strip.up, direction)};
    return (aside / glm::dot(strip.forward, direction) - strip.first) / strip.pitch;
}

double cos_alpha(const Strip& strip, const glm::dvec3& direction) {
    return glm::dot(strip.forward, direction);
}

glm::dmat4 clip_from_sensor(const Strip& strip) {
    const glm::dvec2 half = 0.5 * strip.pitch * glm::dvec2{strip.size_px};
    const glm::dvec2 middle = strip.first + 0.5 * strip.pitch * glm::dvec2{strip.size_px - 1};
    const glm::dvec3 x = (strip.left - middle.x * strip.forward) / half.x;
    const glm::dvec3 y = (strip.up - middle.y * strip.forward) / half.y;
    return glm::transpose(glm::dmat4{glm::dvec4{x, 0.0}, glm::dvec4{y, 0.0},
                                     glm::dvec4{0.0, 0.0, 0.0, near_m},
                                     glm::dvec4{strip.forward, 0.0}});
}

Frustum::Frustum(const Strip& strip, const Pose& anchored_from_sensor)
    : eye_m_(anchored_from_sensor.translation_m),
      forward_(anchored_from_sensor.rotation * strip.forward),
      forward_reach_(glm::abs(forward_)) {
    const glm::dvec2 low = strip.first - 0.5 * strip.pitch;
    const glm::dvec2 high = low + strip.pitch * glm::dvec2{strip.size_px};
    const std::array<glm::dvec3, 4> in_sensor{
        strip.left - low.x * strip.forward, high.x * strip.forward - strip.left,
        strip.up - low.y * strip.forward, high.y * strip.forward - strip.up};
    std::ranges::transform(in_sensor, inward_.begin(), [&](const glm::dvec3& normal) {
        return glm::vec3{anchored_from_sensor.rotation * normal};
    });
    std::ranges::transform(inward_, reaches_.begin(),
                           [](const glm::vec3& normal) { return glm::abs(normal); });
}

Frustum::Place Frustum::place_of(const glm::vec3& middle_m, const glm::vec3& half_m) const {
    if (glm::dot(forward_, middle_m) + glm::dot(forward_reach_, half_m) < 0.0F)
        return Place::beyond;
    Place place = Place::inside;
    for (std::size_t side = 0; side < inward_.size(); ++side) {
        const float inside_m = glm::dot(inward_[side], middle_m);
        const float reach_m = glm::dot(reaches_[side], half_m);
        if (inside_m + reach_m < 0.0F) return Place::beyond;
        if (inside_m - reach_m < 0.0F) place = Place::across;
    }
    return place;
}

}  // namespace scipd::sim
