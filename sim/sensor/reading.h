// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a sensor makes of one echo: a range, or why it tells none. A value; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

namespace scipd::sim {

/// Why there is a range or none. Which code stands for it on a wire is the model's matter.
enum class Cause : std::uint8_t {
    measured,      ///< there is a range
    nothing,       ///< no echo
    too_dark,      ///< the echo is too weak
    too_bright,    ///< the echo blinds the receiver
    edge,          ///< two surfaces in the footprint contradict each other
    interference,  ///< another scanner's light
    lost,          ///< the sensor failed to measure, as it does now and then
};

/// So many neighbouring beams fail alike.
inline constexpr std::size_t code_group = 4;

struct Reading {
    float range_m = std::numeric_limits<float>::infinity();  ///< finite where it was measured
    /// The light that arrives, relative to that of a white matt face head-on at one metre; 0 where
    /// the scanner does not see light.
    float signal = 0.0F;
    float intensity = 0.0F;  ///< what the sensor calls it, in no unit
    Cause cause = Cause::nothing;
    /// Decides among the codes that the model has for a cause; 0: the usual one. A group of
    /// code_group beams shares it.
    std::uint16_t chance = 0;

    bool operator==(const Reading&) const = default;
};

}  // namespace scipd::sim
