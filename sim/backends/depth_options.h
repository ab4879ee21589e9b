// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What to do about the error of ray directions: pixels look where the projection says and beams
// where the scanner says. The depth-buffer method knows four answers, and they can be combined:
// ignore it, interpolate, draw more pixels, draw more passes.
#pragma once

#include <numbers>

namespace scipd::sim {

enum class BetweenPixels {
    nearest,      ///< the depth of the nearest pixel as if the beam went there
    interpolate,  ///< 1/z between pixels that show the same triangle; else as exact
    exact,        ///< the beam is cut with the triangles that the pixels around it show
};

struct DepthOptions {
    BetweenPixels between_pixels = BetweenPixels::exact;
    /// Pixels from one beam to the next, at least. Grids that match the pixels need one.
    double oversample = 1.0;
    /// Directions farther apart are drawn in several passes.
    double widest_pass_rad = 0.5 * std::numbers::pi;

    bool operator==(const DepthOptions&) const = default;
};

}  // namespace scipd::sim
