// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/values/directions.h"

#include <cmath>
#include <numbers>

namespace scipd::sim {
namespace {

constexpr double full_turn_rad = 2 * std::numbers::pi;

}  // namespace

Directions with_angles(Directions directions, const ScannerIdentity& identity) {
    if (!directions.first_step || !identity.front_step || identity.steps_per_turn.value_or(0) <= 0)
        return directions;
    const double step_rad = full_turn_rad / *identity.steps_per_turn;
    directions.first_rad = (*directions.first_step - *identity.front_step) * step_rad;
    directions.increment_rad = step_rad * directions.cluster;
    return directions;
}

void learn_turn(const Directions& directions, ScannerIdentity& identity) {
    constexpr double most_steps = 1e6;
    if (!directions.first_step || !directions.first_rad || !directions.increment_rad) return;
    const double step_rad = *directions.increment_rad / directions.cluster;
    const double steps = full_turn_rad / step_rad;
    const double from_front = *directions.first_rad / step_rad;
    if (!(steps >= 1 && steps < most_steps && std::abs(from_front) < most_steps)) return;
    identity.steps_per_turn = static_cast<int>(std::lround(steps));
    identity.front_step = *directions.first_step - static_cast<int>(std::lround(from_front));
}

}  // namespace scipd::sim
