// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Single rays into a world by every backend that this machine has, for ranges that are known.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "sim/backends/registry.h"

namespace scipd::sim {

inline std::vector<std::string> backends_here() {
    std::vector<std::string> names;
    for (const BackendInfo& backend : backends()) {
        try {
            make_backend(backend.name, std::make_shared<const Scene>());
            names.emplace_back(backend.name);
        } catch (const std::runtime_error&) {
            continue;  // it cannot draw here
        }
    }
    return names;
}

/// Infinity: it meets nothing.
inline void expect_range(const SharedScene& scene, const glm::dvec3& from_m,
                         const glm::dvec3& direction, double range_m) {
    const glm::vec3 ahead{glm::normalize(direction)};
    const Pose world_from_sensor{from_m, Pose{}.rotation};
    for (const std::string& name : backends_here()) {
        Hit hit;
        make_backend(name, scene)
            ->cast({.directions = {&ahead, 1}, .world_from_sensor = {&world_from_sensor, 1}},
                   {&hit, 1});
        EXPECT_EQ(hit.met(), std::isfinite(range_m)) << name;
        if (hit.met() && std::isfinite(range_m)) {
            EXPECT_NEAR(hit.range_m, range_m, 5e-4) << name;
        }
    }
}

}  // namespace scipd::sim
