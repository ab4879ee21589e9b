// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The optics of one product: where its beams point, when they are fired, how far it sees and how
// well. No wire facts: those are protocol::DeviceProfile.
#pragma once

#include <vector>

#include "sim/time.h"

namespace scipd::sim {

/// Standard deviation of a range: sigma_m + sigma_share * range from this range on.
struct NoiseStep {
    double from_range_m;
    double sigma_m;
    double sigma_share;

    bool operator==(const NoiseStep&) const = default;
};

struct SensorSpec {
    int steps_per_turn = 0;  ///< ARES
    int first_step = 0;      ///< first and last step that are measured, both inclusive
    int last_step = 0;
    int front_step = 0;            ///< points along +x of S
    Time scan_period{};            ///< one turn
    double max_range_m{};          ///< no beam sees farther
    std::vector<NoiseStep> noise;  ///< by growing from_range_m, the first at 0; empty: none

    bool operator==(const SensorSpec&) const = default;

    [[nodiscard]] int beams() const { return last_step - first_step + 1; }
    /// Counter-clockwise positive seen from above, 0 at the front.
    [[nodiscard]] double angle_rad(int step) const;
    /// Of the noise at this range; 0 where there is none.
    [[nodiscard]] double sigma_m(double range_m) const;
};

}  // namespace scipd::sim
