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

}  // namespace scipd::sim
