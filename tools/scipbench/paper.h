// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What Friedmann, Petersen and von Stryk measured on three laptops of their time, in milliseconds,
// in the order of paper_resolutions(). Data.
#pragma once

#include <array>
#include <cstddef>

namespace scipd::tools {

inline constexpr std::size_t resolutions = 13;

struct PaperComputer {
    const char* name;
    std::array<double, resolutions> rays_ms;
    std::array<double, resolutions> rays_with_material_ms;
    std::array<double, resolutions> depth_ms;
    std::array<double, resolutions> depth_with_material_ms;
    std::array<double, resolutions> read_depth_ms;
    std::array<double, resolutions> read_frame_ms;
};

/// Tables 2, 3 and 4 of "Evaluation and Enhancement of Common Simulation Methods for Robotic Range
/// Sensors" (SIMPAR 2010).
extern const std::array<PaperComputer, 3> paper_computers;

}  // namespace scipd::tools
