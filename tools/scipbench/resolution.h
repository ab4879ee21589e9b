// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The resolutions of the paper's tables: pictures through a pinhole, 90 degrees wide, one ray for
// each pixel.
#pragma once

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

}  // namespace scipd::tools
