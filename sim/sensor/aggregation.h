// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The aggregation of rays: a sensor that tells one range casts many rays, and this chooses the hit
// whose range it tells. The range is that of one thing and never lies between two. Noise is added
// later. Values; any thread.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/backends/fan.h"

namespace scipd::sim {

enum class Aggregate {
    /// The least range: the paper's easiest way.
    nearest,
    /// The nearest range at which a twentieth of the whole weight of all hits is reached. A hit at
    /// the angle a off the axis weighs exp(-4 a^2 / b^2), where b is the angle of the rim: 1 on the
    /// axis, 0.018 at the rim. An echo needs that twentieth to be heard beside those behind it, so
    /// something thin near the rim is missed. An echo that is alone is never too weak.
    ///
    /// This is an assumption: the main lobe of a transducer is commonly approximated by a Gaussian
    /// lobe, here for the way there and back. Share and width are not those of any product.
    weighted,
};

class Aggregation {
  public:
    /// `directions` fill a cone around +x; the widest of them is its rim.
    Aggregation(Aggregate kind, std::span<const glm::vec3> directions);

    /// Chooses one of the hits, of which there is one for each direction. Nothing where no ray met
    /// anything.
    [[nodiscard]] std::optional<std::size_t> choose(std::span<const Hit> hits) const;

  private:
    std::vector<double> weights_;
    double share_;  ///< of the weight of all hits, from which on an echo is heard
};

}  // namespace scipd::sim
