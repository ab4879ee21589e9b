// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/resolution.h"

#include <array>

#include <glm/geometric.hpp>

namespace scipd::tools {

std::string Resolution::name() const {
    return std::to_string(rows) + "x" + std::to_string(columns);
}

sim::Strip Resolution::strip() const {
    const double pitch = columns == 1 ? 1e-3 : 2.0 / columns;
    return {.first = {-0.5 * pitch * (columns - 1), -0.5 * pitch * (rows - 1)},
            .pitch = {pitch, pitch},
            .size_px = {columns, rows}};
}

std::vector<glm::vec3> Resolution::directions() const {
    const sim::Strip strip = this->strip();
    std::vector<glm::vec3> all;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const glm::dvec2 at = strip.first + strip.pitch * glm::dvec2{column, row};
            all.emplace_back(glm::normalize(strip.forward + at.x * strip.left + at.y * strip.up));
        }
    }
    return all;
}

std::span<const Resolution> paper_resolutions() {
    static constexpr std::array<Resolution, 13> all{{{1, 1},
                                                     {1, 3},
                                                     {1, 10},
                                                     {1, 30},
                                                     {1, 100},
                                                     {1, 300},
                                                     {1, 1000},
                                                     {35, 35},
                                                     {50, 50},
                                                     {70, 70},
                                                     {100, 100},
                                                     {140, 140},
                                                     {200, 200}}};
    return all;
}

}  // namespace scipd::tools
