// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The scanners of a world as others see them: lamps that turn. A scanner whose receiver looks at a
// lamp while the lamp shines at it measures the lamp's pulses and not its own. Lives on the I/O
// thread.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/time.h"

namespace scipd::daemon {

/// The light of a lamp at one instant, in W.
struct LampBeam {
    glm::dvec3 from_m;
    glm::dvec3 direction;
    double half_width_rad = 0.0;
};

class Lamp {
  public:
    Lamp() = default;
    Lamp(const Lamp&) = delete;
    Lamp& operator=(const Lamp&) = delete;
    virtual ~Lamp() = default;

    /// Nothing while it is dark.
    [[nodiscard]] virtual std::optional<LampBeam> shines(sim::Time time) const = 0;
};

/// All lamps of a world. Each adds and removes itself.
class Lamps {
  public:
    void add(const Lamp& lamp) { lamps_.push_back(&lamp); }
    void remove(const Lamp& lamp) { std::erase(lamps_, &lamp); }
    [[nodiscard]] const std::vector<const Lamp*>& all() const { return lamps_; }

  private:
    std::vector<const Lamp*> lamps_;
};

/// A receiver at one instant, in W, and what its beam met.
struct Gaze {
    glm::dvec3 from_m;
    glm::dvec3 direction;
    double half_width_rad = 0.0;
    double range_m = 0.0;
};

/// Whether the receiver looks at the lamp and the lamp at the receiver, with nothing between them.
/// Both have windows of `window_radius_m`.
inline constexpr double window_radius_m = 0.03;
[[nodiscard]] bool dazzles(const LampBeam& lamp, const Gaze& gaze);

}  // namespace scipd::daemon
