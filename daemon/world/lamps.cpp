// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/lamps.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace scipd::daemon {
namespace {

/// Whether this is within a cone; the direction has unit length.
bool within(const glm::dvec3& way, const glm::dvec3& direction, double half_width_rad) {
    return glm::dot(way, direction) >= std::cos(half_width_rad) * glm::length(way);
}

}  // namespace

bool dazzles(const LampBeam& lamp, const Gaze& gaze) {
    const glm::dvec3 way = lamp.from_m - gaze.from_m;
    const double distance_m = glm::length(way);
    // A model of the scanner's housing may stand around its window: that of a UST is 5 cm wide.
    constexpr double housing_m = 0.04;
    if (distance_m < window_radius_m || distance_m > gaze.range_m + housing_m) return false;
    const double window_rad = std::atan2(window_radius_m, distance_m);
    return within(way, gaze.direction, gaze.half_width_rad + window_rad) &&
           within(-way, lamp.direction, lamp.half_width_rad + window_rad);
}

}  // namespace scipd::daemon
