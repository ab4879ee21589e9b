// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How ranges and intensities of a sensor vary from scan to scan, as data. docs/errors.md says what
// recordings these laws come from. Values; any thread.
#pragma once

namespace scipd::sim {

/// The deviation of a range: sigma_m + sigma_share * range from this range on.
struct NoiseStep {
    double from_range_m;
    double sigma_m;
    double sigma_share;

    bool operator==(const NoiseStep&) const = default;
};

/// The deviation of a range on a flat face, by the intensity that the receiver makes of the light:
/// floor_m * sqrt(1 + (weak / intensity)²). Timing noise is receiver noise over the slope of the
/// pulse, and the floor is what bright light leaves.
struct NoiseLaw {
    double floor_m = 0.0;
    double weak = 0.0;  ///< the intensity whose deviation is sqrt(2) times the floor

    bool operator==(const NoiseLaw&) const = default;
};

/// The deviation of the intensity itself, as a share of it.
struct IntensityNoisePoint {
    double intensity;
    double share;

    bool operator==(const IntensityNoisePoint&) const = default;
};

/// What a sensor makes of neighbouring beams that see the same face.
struct Smoothing {
    /// How much a beam gets of the noise of the next beam and of the one after, on either side,
    /// where it has 1 of its own. The sum is scaled, so that its deviation stays.
    double next = 0.0;
    double after_next = 0.0;
    /// A reading is the median of five beams, and next and after_next do not count.
    bool median_of_five = false;

    [[nodiscard]] bool none() const { return !median_of_five && next == 0.0 && after_next == 0.0; }
    bool operator==(const Smoothing&) const = default;
};

}  // namespace scipd::sim
