// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Makes the same scans with every backend: how far they differ, where, and what they cost.
#pragma once

#include <array>
#include <iosfwd>
#include <string>
#include <vector>

#include "sim/backends/fan.h"
#include "sim/world/scene.h"
#include "tools/scipbench/spread.h"

namespace scipd::tools {

/// One backend, compared with rays.
struct Comparison {
    std::string backend;
    std::string missing;  ///< why the backend is not available; the rest is empty then
    Spread cost_ms;       ///< of a scan
    std::size_t beams = 0;
    std::size_t edges = 0;          ///< beams with another surface within half a pixel
    std::size_t other_surface = 0;  ///< beams that are off by more than a centimetre
    std::size_t other_object = 0;   ///< of those away from edges: right range, but another object
    /// How far the beams away from edges are off: the median, the percentiles 99 and 99.9, and the
    /// maximum.
    std::array<double, 4> off_m{};
};

/// A place in W where a backend and the rays differ.
struct Difference {
    glm::dvec3 place_m;
    double off_m;
};

struct ComparedScans {
    std::vector<Comparison> backends;
    std::vector<Difference> differences;  ///< of the depth backend
    std::vector<glm::dvec3> hits_m;       ///< by rays
};

/// Casts these directions from `poses` free poses of the scene, at this height.
ComparedScans compare_backends(const sim::SharedScene& scene,
                               const std::vector<glm::vec3>& directions, double max_range_m,
                               std::size_t poses, double height_m);

void print_comparison(const ComparedScans& scans, std::ostream& out);
void write_comparison_json(const ComparedScans& scans, std::ostream& out);

}  // namespace scipd::tools
