// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The aggregation of rays: which of many hits a sensor that tells one range speaks of. It always is
// one of them, so the range is that of a thing and never lies between two. Chance comes later.
// Values; any thread.
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
    /// What the directions say counts as well: the nearest range by which a twentieth of all that
    /// came back is there. Each hit weighs exp(-4 a^2 / b^2), a off the axis, b at the rim: 1 on
    /// the axis, 0.018 at the rim. A twentieth is what an echo needs to be heard beside those
    /// behind it; so the axis outweighs the rim, and what is thin and aside is missed. Nothing is
    /// too weak where it is alone.
    ///
    /// An assumption: a Gaussian lobe, which is how the main lobe of a transducer is commonly
    /// approximated, there and back; share and width are not those of any product.
    weighted,
};

class Aggregation {
  public:
    /// `directions`: of a cone around +x; the widest is its rim.
    Aggregation(Aggregate kind, std::span<const glm::vec3> directions);

    /// Which of the hits, one a direction; nothing where none met anything.
    [[nodiscard]] std::optional<std::size_t> choose(std::span<const Hit> hits) const;

  private:
    std::vector<double> weights_;
    double share_;  ///< of the weight that came back: so much is heard
};

}  // namespace scipd::sim
