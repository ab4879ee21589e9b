// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The way of one beam through the media of a world: how much light is left of it, and what drops or
// flakes it meets. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/random.h"
#include "sim/world/medium.h"

namespace scipd::sim {

class AirPath {
  public:
    /// A beam in W that begins there.
    AirPath(std::span<const Medium> media, const glm::dvec3& from_m, const glm::dvec3& direction);

    /// What is left of light that goes so far and comes back: Beer and Lambert's law, both ways.
    [[nodiscard]] double left(double range_m) const;

    struct Drop {
        double range_m;
        double brightness;
    };
    /// The first drop or flake of each medium that the beam meets nearer than `range_m`. Drops are
    /// spread at random, so the way to the first one is exponentially distributed.
    [[nodiscard]] std::vector<Drop> drops(double range_m, const Chance& chance,
                                          std::uint32_t beam) const;

  private:
    struct Stretch {
        const Medium* medium;
        std::uint32_t index;  ///< of the medium
        double from_m;        ///< from the beam's beginning
        double to_m;
    };
    std::vector<Stretch> stretches_;
};

}  // namespace scipd::sim
