// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Turns echoes into what a sensor reads: whether it notices an echo, and with which error. Pure:
// chance follows from the seed, the sensor and the revolution, so a scan does not depend on threads
// or on the client that asked.
#pragma once

#include <cstdint>
#include <span>

#include "sim/random.h"
#include "sim/sensor/echo.h"
#include "sim/sensor/reading.h"
#include "sim/sensor/scan.h"
#include "sim/sensor/sensor_spec.h"
#include "sim/sensor/spec_curves.h"
#include "sim/time.h"

namespace scipd::sim {

/// The paper's levels of accuracy. Each has all stages of the one before.
enum class Accuracy {
    ideal,     ///< the ranges of the geometry
    sensor,    ///< errors that follow from the range alone
    material,  ///< errors that follow from the light that comes back
};

/// Which of several echoes a sensor tells that tells only one.
enum class EchoChoice { first, strongest, last };

struct ErrorModel {
    Accuracy accuracy = Accuracy::sensor;
    std::uint64_t seed = 0;
    std::uint64_t sensor = 0;  ///< stable over runs: derived from the sensor's name
    EchoChoice choice = EchoChoice::strongest;
    /// It tells up to most_echoes_told of them.
    bool tells_every_echo = false;
    /// Its codes vary: the readings without a range need chances for them.
    bool codes_vary = false;
    static constexpr std::size_t most_echoes_told = 3;
    /// All noise is so many times the model's.
    double noise_factor = 1.0;

    /// Fills the readings of a scan from its echoes, or from its hits where it has no echoes.
    /// `on_for`: since when the sensor is switched on.
    void read(const SensorSpec& spec, Time on_for, Scan& scan) const {
        read(spec, SpecCurves(spec), on_for, scan);
    }
    /// Reads in less time: `curves` are those of `spec`.
    void read(const SensorSpec& spec, const SpecCurves& curves, Time on_for, Scan& scan) const;

    /// What a sensor reads of one hit; `beam` tells one chance from another.
    [[nodiscard]] Reading read(const SensorSpec& spec, Time on_for, std::int64_t revolution,
                               const Hit& hit, std::uint32_t beam = 0) const;

    [[nodiscard]] ChanceKey key(std::int64_t revolution = 0) const {
        return {.seed = seed, .sensor = sensor, .scan = static_cast<std::uint64_t>(revolution)};
    }
};

/// The signal of an echo: its light falls with the square of the range. Nearer than the receiver's
/// level range it stays as it is there.
[[nodiscard]] float signal_of(const Receiver& receiver, float range_m, float power);

/// What a receiver reads too far of such light, whatever chance does: its walk, and what too strong
/// a signal adds.
[[nodiscard]] double light_error_m(const Receiver& receiver, double power, double signal);

/// What the sensor that read this reads too far there, whatever chance does and however warm it is.
[[nodiscard]] double steady_error_m(const SensorSpec& spec, const Reading& reading);

/// The weakest signal that the receiver notices half the time; 0: it notices all.
[[nodiscard]] float weakest_signal(const Receiver& receiver);

/// Below and above weakest_signal() the share of echoes that are noticed goes from none to all as
/// the normal distribution of the signal's logarithm with this deviation. Assumed.
inline constexpr double noticing_spread = 0.05;

}  // namespace scipd::sim
