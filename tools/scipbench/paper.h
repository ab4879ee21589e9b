// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Measurements of Friedmann, Petersen and von Stryk on three laptops of their time, in
// milliseconds, and their resolutions: pictures through a pinhole, 90 degrees wide, one ray for
// each pixel. Data.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/backends/depth_projection.h"

namespace scipd::tools {

struct Resolution {
    int rows;
    int columns;

    [[nodiscard]] int rays() const { return rows * columns; }
    [[nodiscard]] std::string name() const;
    /// Columns are 90 degrees wide, and rows have the same spacing. A single pixel is a narrow one.
    [[nodiscard]] sim::Strip strip() const;
    /// The directions of the pixels' centres, row by row.
    [[nodiscard]] std::vector<glm::vec3> directions() const;
};

/// 1x1 to 1x1000, then 35x35 to 200x200.
std::span<const Resolution> paper_resolutions();

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
