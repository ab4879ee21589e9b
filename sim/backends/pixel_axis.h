// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where the pixels of a strip lie along one of its two axes. Pure.
#pragma once

#include <optional>
#include <vector>

namespace scipd::sim {

/// Directions are float: what differs by less is the same.
inline constexpr double same_direction = 1e-6;

/// In tangents.
struct PixelAxis {
    double first = 0.0;  ///< the first pixel's centre
    double pitch = 1e-3;
    int count = 1;
};

/// In order, each once.
std::vector<double> distinct(std::vector<double> values);

/// Where the values, distinct ones, are evenly spaced: a pixel for each of them, and between them
/// as many as the factor and the coarsest pitch ask for.
std::optional<PixelAxis> even_axis(const std::vector<double>& values, double oversample,
                                   double coarsest_pitch);

/// Pixels from the first value to the last, at most so far apart.
PixelAxis dense_axis(double first, double last, double pitch);

double median(std::vector<double> values);

}  // namespace scipd::sim
