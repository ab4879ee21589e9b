// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The same scans by every backend: how far they differ, where, and what they cost.
#pragma once

#include <array>
#include <iosfwd>
#include <string>
#include <vector>

#include "sim/backends/fan.h"
#include "sim/world/scene.h"
#include "tools/scipbench/spread.h"

namespace scipd::tools {

/// One backend beside the yardstick, which is rays.
struct Comparison {
    std::string backend;
    std::string missing;  ///< why it could not be had; the rest is empty then
    Spread cost_ms;       ///< of a scan
    std::size_t beams = 0;
    std::size_t edges = 0;          ///< beams with another surface within half a pixel
    std::size_t other_surface = 0;  ///< beams that are off by more than a centimetre
    std::size_t other_object = 0;   ///< of those that agree, away from edges, where objects touch
    /// Of the difference away from edges: half, 99 and 99.9 of 100, and all.
    std::array<double, 4> off_m{};
};

/// Where a backend and the yardstick differ, in W.
struct Difference {
    glm::dvec3 place_m;
    double off_m;
};

struct ComparedScans {
    std::vector<Comparison> backends;
    std::vector<Difference> differences;  ///< of the depth backend
    std::vector<glm::dvec3> hits_m;       ///< of the yardstick
};

/// A sensor's directions from so many free poses of the scene, this high.
ComparedScans compare_backends(const sim::SharedScene& scene,
                               const std::vector<glm::vec3>& directions, double max_range_m,
                               std::size_t poses, double height_m);

void print_comparison(const ComparedScans& scans, std::ostream& out);
void write_comparison_json(const ComparedScans& scans, std::ostream& out);

}  // namespace scipd::tools
