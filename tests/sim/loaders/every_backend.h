// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Single rays into a world by every backend that this machine has, for ranges that are known.
#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "sim/backends/registry.h"

namespace scipd::sim {

/// Keeps those of the scene that was asked for last: to make one that draws takes a while.
inline const std::map<std::string, std::unique_ptr<RangeBackend>>& backends_for(
    const SharedScene& scene) {
    static SharedScene last;
    static std::map<std::string, std::unique_ptr<RangeBackend>> all;
    if (scene == last) return all;
    last = scene;
    all.clear();
    for (const BackendRow& backend : backends()) {
        try {
            all.emplace(backend.name, make_backend(backend.name, scene));
        } catch (const std::runtime_error&) {
            continue;  // it cannot draw here
        }
    }
    return all;
}

/// Infinity: it meets nothing.
inline void expect_range(const SharedScene& scene, const glm::dvec3& from_m,
                         const glm::dvec3& direction, double range_m) {
    const glm::vec3 ahead{glm::normalize(direction)};
    const Pose world_from_sensor{from_m, Pose{}.rotation};
    for (const auto& [name, backend] : backends_for(scene)) {
        Hit hit;
        backend->cast({.directions = {&ahead, 1}, .world_from_sensor = {&world_from_sensor, 1}},
                      {&hit, 1});
        EXPECT_EQ(hit.met(), std::isfinite(range_m)) << name;
        if (hit.met() && std::isfinite(range_m)) {
            EXPECT_NEAR(hit.range_m, range_m, 5e-4) << name;
        }
    }
}

}  // namespace scipd::sim
