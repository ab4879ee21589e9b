// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/pinhole_grid.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace scipd::sim {
namespace {

/// The tangent of the middle of pixel i of so many; that of the first one is the greatest.
double tangent(int i, int count, double angle_rad) {
    return std::tan(0.5 * angle_rad) * (count - 1 - 2 * i) / count;
}

}  // namespace

std::vector<glm::vec3> PinholeGrid::directions() const {
    std::vector<glm::vec3> all;
    all.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (int row = 0; row < rows; ++row) {
        const double up = tangent(row, rows, height_rad);
        for (int column = 0; column < columns; ++column)
            all.emplace_back(
                glm::normalize(glm::dvec3{1.0, tangent(column, columns, width_rad), up}));
    }
    return all;
}

}  // namespace scipd::sim
