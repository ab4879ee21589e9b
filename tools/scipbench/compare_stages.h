// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Makes the same scans with every backend at Accuracy::material, and compares what comes after the
// hits: echoes and readings. Chance is the same for all, so readings differ only where echoes do.
#pragma once

#include <array>
#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

#include "sim/sensor/sensor_spec.h"
#include "sim/world/material_library.h"
#include "sim/world/scene.h"

namespace scipd::tools {

/// One backend, compared with rays.
struct StageComparison {
    std::string backend;
    std::string missing;  ///< why the backend is not available; the rest is empty then
    bool follows_light = false;
    std::size_t beams = 0;
    std::size_t other_count = 0;  ///< beams with more or fewer echoes
    std::size_t other_cause = 0;  ///< beams that read for one backend and not for the other
    // The median and the percentile 99, of the beams with as many echoes.
    std::array<double, 2> echo_off_m{};
    std::array<double, 2> power_off{};  ///< relative
    std::array<double, 2> reading_off_m{};
};

std::vector<StageComparison> compare_stages(const sim::SharedScene& scene,
                                            const sim::SensorSpec& optics,
                                            const sim::MaterialLibrary& materials,
                                            std::size_t poses, double height_m);

void print_stages(const std::vector<StageComparison>& backends, std::ostream& out);

}  // namespace scipd::tools
