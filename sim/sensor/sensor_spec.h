// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The optics of one product: where its beams point, when they are fired, how far it sees and how
// well. No wire facts: those are protocol::DeviceProfile.
#pragma once

#include <vector>

#include "sim/sensor/curve.h"
#include "sim/sensor/footprint.h"
#include "sim/sensor/noise_law.h"
#include "sim/time.h"

namespace scipd::sim {

/// How much too far a sensor reads at this range.
struct BiasPoint {
    double range_m;
    double bias_m;

    bool operator==(const BiasPoint&) const = default;
};

/// How far off the data sheet lets a unit be, on average, from this range on:
/// bound_m + bound_share * range.
struct AccuracyStep {
    double from_range_m;
    double bound_m;
    double bound_share;

    bool operator==(const AccuracyStep&) const = default;
};

/// A cold sensor reads too far by drift_m * exp(-t / time_constant) when it has been on for t.
struct WarmUp {
    double drift_m = 0.0;
    Time time_constant{};

    bool operator==(const WarmUp&) const = default;
};

/// What a sensor calls the light of a white matt face that it meets head-on at this range.
struct IntensityPoint {
    double range_m;
    double intensity;

    bool operator==(const IntensityPoint&) const = default;
};

/// The reflectance of the target that data sheets call dark.
inline constexpr float dark_target = 0.1F;

/// How a sensor sees the light that comes back, at Accuracy::material.
struct Receiver {
    int wavelength_nm = 905;
    /// A matt face of 10 % reflectance is seen up to this range, head-on; 0: everything is seen.
    double dark_range_m = 0.0;
    /// Faces that lie closer behind each other than this are one echo: half the length of a pulse.
    double half_pulse_m = 0.5;
    /// Nearer than this the gain no longer rises with the light.
    double level_below_m = 0.5;
    /// How much farther an echo reads that is ten times weaker than a white face's (walk error).
    double walk_m = 0.0;
    /// A signal from which on the receiver is blinded, in those of a white face at one metre; 0:
    /// never.
    double blinding_signal = 0.0;
    /// A signal that drives the receiver out of its linear range, in the same measure; 0: none
    /// does. One that is ten times stronger reads saturation_m farther.
    double saturating_signal = 0.0;
    double saturation_m = 0.0;
    /// Where a beam has two echoes and the weaker one has more than this share of the stronger, the
    /// sensor reads no range: those that compare phases. 0: such sensors read one of the two.
    double edge_share = 0.0;
    /// Half the width of the lens: what a mirror throws back is seen where it falls into that.
    double aperture_m = 0.0;
    /// The share of its neighbours' light that a beam gets.
    double crosstalk = 0.0;
    /// By growing range_m; linear between, and constant before and behind. Empty: no intensity.
    std::vector<IntensityPoint> intensity = {};
    /// How many intensities of a white face are added where there is e times as much light, above
    /// that of a white face; 0: as many as there is light.
    double log_gain = 0.0;
    double most_intensity = 0.0;  ///< brighter light is told as this
    /// By growing intensity; linear between, and constant before and behind. Empty: none.
    std::vector<IntensityNoisePoint> intensity_noise = {};

    bool operator==(const Receiver&) const = default;

    /// How bright light of this power (Echo) is, in intensities of a white face at the same range.
    [[nodiscard]] double brightness(double power) const;
};

struct SensorSpec {
    int steps_per_turn = 0;  ///< ARES
    int first_step = 0;      ///< first and last step that are measured, both inclusive
    int last_step = 0;
    int front_step = 0;    ///< points along +x of S
    Time scan_period{};    ///< one turn
    double max_range_m{};  ///< no beam sees farther
    /// The noise of ranges, where it follows from the light.
    NoiseLaw noise_law = {};
    /// The deviation for a white wall head-on, in place of that law; by growing from_range_m, the
    /// first at 0. Empty: the law decides.
    std::vector<NoiseStep> noise = {};
    Smoothing smoothing = {};
    std::vector<AccuracyStep> accuracy = {};  ///< of the data sheet, by growing range
    /// By growing range_m; linear between, and constant before and behind. Empty: none.
    std::vector<BiasPoint> bias = {};
    WarmUp warm_up = {};
    double lost_share = 0.0;  ///< of the beams, at random
    double lattice_m = 0.0;   ///< ranges are multiples of this; below 1e-5: any
    Footprint footprint = {};
    Receiver receiver = {};

    bool operator==(const SensorSpec&) const = default;

    [[nodiscard]] int beams() const { return last_step - first_step + 1; }
    /// Counter-clockwise positive seen from above, 0 at the front.
    [[nodiscard]] double angle_rad(double step) const;
    /// From one step to the next.
    [[nodiscard]] double beam_rad() const;
    /// The deviation that it reads a white wall with, head-on at this range.
    [[nodiscard]] double sigma_m(double range_m) const;
    [[nodiscard]] double bias_m(double range_m) const;
    /// The accuracy of the data sheet; infinite where it tells none.
    [[nodiscard]] double accuracy_m(double range_m) const;
    /// The intensity that is told of light of this power (Echo) from this range.
    [[nodiscard]] double intensity(double range_m, double power) const;
    /// The intensity of a dark target at dark_range_m.
    [[nodiscard]] double faintest_intensity() const;
};

/// The noise by range of a white wall head-on: what `noise` says, else what the law makes of the
/// intensities of such a wall.
[[nodiscard]] Curve white_wall_noise(const SensorSpec& spec);

}  // namespace scipd::sim
