// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/pose.h"

#include <array>

#include "daemon/config/numbers.h"

namespace scipd::daemon {

sim::Pose read_pose(const Section& parent, std::string_view key, Faults& faults) {
    static constexpr std::array<std::string_view, 2> keys{"xyz", "rpy"};
    const Field* field = parent.find(key);
    if (!field) return {};
    const Section section{*field, {keys, {}}, faults};
    glm::dvec3 xyz_m{0.0};
    glm::dvec3 rpy_rad{0.0};
    section.read_vector("xyz", xyz_m, parse_metres);
    section.read_vector("rpy", rpy_rad, parse_radians);
    return sim::pose_from_rpy(xyz_m, rpy_rad);
}

}  // namespace scipd::daemon
