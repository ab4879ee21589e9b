// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/outside_world.h"

#include <array>

#include "sim/text/likely_unit.h"

namespace scipd::daemon {
namespace {

bool within(const sim::Bounds& world, const glm::dvec3& point_m, int axis) {
    constexpr double margin_m = 10.0;
    return point_m[axis] >= world.low_m[axis] - margin_m &&
           point_m[axis] <= world.high_m[axis] + margin_m;
}

}  // namespace

bool beside(const sim::Bounds& world, const glm::dvec3& point_m) {
    return !within(world, point_m, 0) || !within(world, point_m, 1);
}

bool outside(const sim::Bounds& world, const glm::dvec3& point_m) {
    return beside(world, point_m) || !within(world, point_m, 2);
}

std::optional<std::string> millimetres_beside(const sim::Bounds& world, const glm::dvec3& xyz_m) {
    constexpr double m_per_mm = 1e-3;
    const std::array numbers{xyz_m.x, xyz_m.y, xyz_m.z};
    const bool likely = sim::could_be_millimetres(numbers) && !world.empty() &&
                        beside(world, xyz_m) && !beside(world, m_per_mm * xyz_m);
    return likely ? std::optional(sim::millimetres_for_metres(numbers)) : std::nullopt;
}

}  // namespace scipd::daemon
