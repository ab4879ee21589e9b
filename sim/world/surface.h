// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a face does with light of one wavelength that falls on it. Shares are of the light that
// falls on the face; reflected, retro-reflected and transmitted light together are at most all of
// it. Values; any thread.
#pragma once

namespace scipd::sim {

struct Surface {
    /// The share that the face scatters to all sides.
    float diffuse = 0.9F;
    /// The share that it throws back as a mirror does, more or less blurred.
    float specular = 0.0F;
    /// Phong's exponent of that: 1 is wide, 1e5 a mirror.
    float gloss = 1.0F;
    /// The share that goes back to where it came from, within retro_cone_rad.
    float retro = 0.0F;
    /// The share that goes straight on behind the face.
    float transmission = 0.0F;
    /// The spread of the slopes of its facets in radians, as Oren and Nayar use it.
    float roughness = 0.0F;
    /// How much what it scatters varies from place to place: the relative standard deviation.
    float texture = 0.0F;

    bool operator==(const Surface&) const = default;
};

/// Half the opening of the cone into which retro-reflectors send light back: the coefficient of
/// retro-reflection is measured up to an observation angle of one degree (ASTM E810).
inline constexpr double retro_cone_rad = 0.01745;

}  // namespace scipd::sim
