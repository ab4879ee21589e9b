// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/paper.h"

#include <array>

#include <glm/geometric.hpp>

namespace scipd::tools {

const std::array<PaperComputer, 3> paper_computers{{
    {"A: Intel GMA X3100, Mac OS X",
     {0.021, 0.017, 0.066, 0.165, 0.467, 1.33, 4.31, 5.52, 12.1, 23.6, 47.6, 93.8, 192},
     {0.023, 0.018, 0.068, 0.165, 0.474, 1.35, 4.37, 5.59, 12.1, 24.0, 48.2, 94.4, 195},
     {6.3, 6.2, 6.14, 6.22, 6.18, 6.12, 6.12, 6.3, 6.78, 6.9, 7.05, 7.4, 7.91},
     {6.33, 6.28, 6.17, 6.27, 6.24, 6.27, 6.35, 7.11, 7.37, 7.54, 7.67, 8.33, 9.53},
     {1.24, 1.21, 1.18, 1.20, 1.21, 1.17, 1.08, 1.30, 1.71, 1.76, 1.78, 1.90, 2.02},
     {0.075, 0.075, 0.077, 0.079, 0.090, 0.111, 0.182, 0.785, 0.621, 0.640, 0.625, 0.802, 1.220}},
    {"B: Quadro NVS 160M, Linux",
     {0.048, 0.041, 0.19, 0.468, 1.35, 4.03, 12.0, 13.7, 19.7, 31.6, 52.8, 91.7, 188},
     {0.05, 0.041, 0.193, 0.569, 1.31, 4.03, 11.2, 12.6, 19.0, 31.6, 52.2, 92.2, 190},
     {3.87, 4.17, 3.89, 3.96, 4.11, 3.88, 4.15, 3.98, 4.19, 4.42, 4.98, 5.86, 7.98},
     {23.2, 23.3, 4.19, 3.98, 3.88, 3.94, 4.13, 4.1, 4.3, 4.62, 5.51, 6.67, 9.65},
     {0.076, 0.078, 0.169, 0.116, 0.130, 0.135, 0.162, 0.166, 0.226, 0.295, 0.491, 0.775, 1.470},
     {0.036, 0.036, 0.068, 0.056, 0.060, 0.056, 0.085, 0.080, 0.100, 0.126, 0.172, 0.272, 0.540}},
    {"C: Quadro NVS 160M, Windows",
     {0.03, 0.027, 0.116, 0.256, 0.758, 2.17, 8.15, 8.07, 20.8, 47.8, 68.3, 126, 259},
     {0.033, 0.031, 0.127, 0.272, 0.782, 2.19, 7.06, 8.64, 21.2, 47.6, 67.7, 129, 263},
     {1.57, 1.52, 1.57, 1.52, 1.55, 1.5, 1.53, 1.62, 1.6, 1.74, 2.11, 2.5, 3.16},
     {1.64, 1.61, 1.58, 1.6, 1.58, 1.7, 1.64, 1.78, 1.81, 1.99, 2.47, 2.91, 4.24},
     {0.312, 0.313, 0.246, 0.289, 0.271, 0.311, 0.296, 0.353, 0.288, 0.308, 0.504, 0.608, 0.887},
     {0.086, 0.093, 0.088, 0.087, 0.089, 0.096, 0.104, 0.186, 0.200, 0.247, 0.298, 0.372, 0.767}},
}};

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
