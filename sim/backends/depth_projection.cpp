// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/depth_projection.h"

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

}  // namespace scipd::sim
