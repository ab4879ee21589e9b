// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What to do about the error of ray directions: a pixel looks in a direction that the projection
// gives, a beam in one that the scanner gives. The depth-buffer method has four answers, which can
// be combined: ignore the error, interpolate, draw more pixels, draw more passes.
#pragma once

#include <numbers>

namespace scipd::sim {

enum class BetweenPixels {
    nearest,      ///< the depth of the nearest pixel, as if the beam passed its centre
    interpolate,  ///< between pixels that show the same triangle, linear in 1/z; else as exact
    exact,        ///< where the beam meets the triangles that the pixels around it show
};

struct DepthOptions {
    BetweenPixels between_pixels = BetweenPixels::exact;
    /// At least so many pixels from one beam to the next. One is enough for a grid of beams that
    /// matches the pixels.
    double oversample = 1.0;
    /// Directions that are farther apart than this are drawn in several passes.
    double widest_pass_rad = 0.5 * std::numbers::pi;

    bool operator==(const DepthOptions&) const = default;
};

}  // namespace scipd::sim
