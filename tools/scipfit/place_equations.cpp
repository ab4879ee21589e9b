// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/place_equations.h"

namespace scipd::tools {
namespace {

/// No scanner is so far off. It decides only where nothing else does.
constexpr double far_off_mm = 300.0;

}  // namespace

PlaceEquations::PlaceEquations(const PlaceFit& fit) {
    const PlaceColumns columns(fit);
    const auto size = static_cast<Eigen::Index>(columns.count());
    matrix = Eigen::MatrixXd::Zero(size, size);
    right = Eigen::VectorXd::Zero(size);
    // What no row says anything of stays.
    constexpr double hardly = 1e-8;
    for (Eigen::Index i = 0; i < size; ++i) {
        const double unit = columns.unit(static_cast<std::size_t>(i));
        matrix(i, i) = hardly / (unit * unit);
    }
    for (std::size_t i = 0; i < fit.bias_mm.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        matrix(at, at) += 1.0 / (far_off_mm * far_off_mm);
        right(at) -= fit.bias_mm[i] / (far_off_mm * far_off_mm);
    }
}

void PlaceEquations::add(const PlaceRow& row, double times, double off) {
    for (std::size_t i = 0; i < row.count; ++i) {
        const auto at = static_cast<Eigen::Index>(row.column[i]);
        right(at) += times * row.weight * row.by[i] * off;
        for (std::size_t k = 0; k < row.count; ++k)
            matrix(at, static_cast<Eigen::Index>(row.column[k])) +=
                times * row.weight * row.by[i] * row.by[k];
    }
}

PlaceFit PlaceEquations::solved(PlaceFit fit) const {
    const Eigen::VectorXd step = matrix.ldlt().solve(right);
    const PlaceColumns columns(fit);
    const auto at = [&](std::size_t column) { return step(static_cast<Eigen::Index>(column)); };
    for (std::size_t i = 0; i < fit.bias_mm.size(); ++i)
        fit.bias_mm[i] += at(i);
    for (std::size_t i = 0; i < fit.places.size(); ++i) {
        fit.places[i].x_mm += at(columns.of_place(i));
        fit.places[i].y_mm += at(columns.of_place(i) + 1);
        fit.places[i].yaw_rad += at(columns.of_place(i) + 2);
    }
    for (std::size_t i = 0; i < fit.faces.size() && fit.fits_faces; ++i) {
        fit.faces[i].normal_rad += at(columns.of_face(i));
        fit.faces[i].distance_mm += at(columns.of_face(i) + 1);
    }
    return fit;
}

}  // namespace scipd::tools
