// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/poses/kitti_line.h"

#include <array>
#include <cmath>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "sim/loaders/poses/pose_columns.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

constexpr std::array kitti_columns{"r11", "r12", "r13", "x",   "r21", "r22",
                                   "r23", "y",   "r31", "r32", "r33", "z"};

/// Each column is an axis of the camera in our frame: right is -y, down is -z, ahead is x.
const glm::dmat3 ours_from_camera{glm::dvec3{0.0, -1.0, 0.0}, glm::dvec3{0.0, 0.0, -1.0},
                                  glm::dvec3{1.0, 0.0, 0.0}};

/// Whether it is one, with the tolerance that numbers of six digits need.
bool is_rotation(const glm::dmat3& matrix) {
    constexpr double tolerance = 1e-3;
    const glm::dmat3 square = glm::transpose(matrix) * matrix;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            if (!(std::abs(square[i][k] - (i == k ? 1.0 : 0.0)) <= tolerance)) return false;
        }
    }
    return glm::determinant(matrix) > 0.0;
}

}  // namespace

Expected<Pose> parse_kitti_line(std::string_view line) {
    const auto cells = cells_of(line, ' ');
    if (cells.size() != kitti_columns.size()) {
        return refuse("a pose has 12 columns, the rows of [R t], this line has " +
                      std::to_string(cells.size()));
    }
    std::array<double, kitti_columns.size()> value{};
    for (std::size_t i = 0; i < value.size(); ++i) {
        const auto number = parse_number(cells[i]);
        if (!number) {
            return refuse(std::string{kitti_columns[i]} + " must be a finite number, not " +
                          quote(cells[i]));
        }
        value[i] = *number;
    }
    // GLM's matrices are columns.
    const glm::dmat3 rotation{glm::dvec3{value[0], value[4], value[8]},
                              glm::dvec3{value[1], value[5], value[9]},
                              glm::dvec3{value[2], value[6], value[10]}};
    if (!is_rotation(rotation)) return refuse("r11 to r33 must be a rotation");
    const glm::dvec3 xyz_m = ours_from_camera * glm::dvec3{value[3], value[7], value[11]};
    if (!plausible_position(xyz_m)) return refuse("x, y and z must lie within 1e7 m of the origin");
    const glm::dmat3 turned = ours_from_camera * rotation * glm::transpose(ours_from_camera);
    return Pose{xyz_m, glm::normalize(glm::quat_cast(turned))};
}

}  // namespace scipd::sim
