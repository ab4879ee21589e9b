// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The footprint of a beam: light leaves the scanner in a narrow cone of elliptic section, brightest
// in its middle. A few rays stand for it. Values; any thread.
#pragma once

#include <span>

namespace scipd::sim {

/// Half the opening of the cone, where the light has fallen to 1/e² of that in the middle.
struct Footprint {
    double half_width_rad = 0.0;   ///< in the plane of the scan
    double half_height_rad = 0.0;  ///< across it
    int rays = 1;                  ///< that stand for it: 1, 7 or 13

    bool operator==(const Footprint&) const = default;

    /// The farthest that any of its rays points away from the beam.
    [[nodiscard]] double reach_rad() const;
};

/// Where a ray points, in halves of the footprint, and its share of the light.
struct FootprintRay {
    double across = 0.0;
    double up = 0.0;
    float weight = 1.0F;
};

/// The rays of a footprint, the middle one first; their weights add up to 1. They are the nodes of
/// cubature formulas for a Gaussian weight, with rings of six around the middle: 7 and 13 rays
/// integrate polynomials of degree 5 exactly (7: Stroud, Approximate calculation of multiple
/// integrals, 1971, E2r2 5-1). `rays` is 1, 7 or 13.
[[nodiscard]] std::span<const FootprintRay> footprint_rays(int rays);

}  // namespace scipd::sim
