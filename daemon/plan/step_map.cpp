// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/step_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scipd::daemon {
namespace {

using Places = std::vector<std::optional<std::size_t>>;

std::optional<std::size_t> within(double place, std::size_t count) {
    const double nearest = std::round(place);
    if (nearest < 0.0 || nearest >= static_cast<double>(count)) return std::nullopt;
    return static_cast<std::size_t>(nearest);
}

Places by_steps(const sim::RecordedScan& scan, int first, const sim::SensorSpec& optics) {
    Places places;
    for (int step = optics.first_step; step <= optics.last_step; ++step) {
        // A value of a cluster stands for all of its steps.
        const int into = step - first;
        const double place = into < 0 ? -1.0 : std::floor(double(into) / scan.directions.cluster);
        places.push_back(within(place, scan.steps()));
    }
    return places;
}

/// Angles are modulo a turn: recordings begin anywhere, and go either way. Where a round scan has
/// its first direction a second time at its end, the first one counts.
Places by_angles(const sim::RecordedScan& scan, const sim::SensorSpec& optics) {
    const double first_rad = *scan.directions.first_rad;
    const double increment_rad = *scan.directions.increment_rad;
    const double values_of_turn = 2.0 * std::numbers::pi / std::abs(increment_rad);
    // Angles of 32 bits may leave a gap of less than a value where a round scan closes.
    const auto last = static_cast<double>(scan.steps()) - 1.0;
    const double most = last + 1.5 > values_of_turn ? last : values_of_turn;
    Places places;
    for (int step = optics.first_step; step <= optics.last_step; ++step) {
        const double place = (optics.angle_rad(step) - first_rad) / increment_rad;
        const double within_turn =
            place - std::floor((place + 0.5) / values_of_turn) * values_of_turn;
        places.push_back(within(std::min(within_turn, most), scan.steps()));
    }
    return places;
}

}  // namespace

Places map_of_steps(const sim::RecordedScan& scan, const sim::SensorSpec& optics) {
    const sim::Directions& directions = scan.directions;
    if (directions.first_step) return by_steps(scan, *directions.first_step, optics);
    if (directions.first_rad && directions.increment_rad && *directions.increment_rad != 0.0)
        return by_angles(scan, optics);
    if (scan.steps() == static_cast<std::size_t>(optics.beams()))
        return by_steps(scan, optics.first_step, optics);
    return {};
}

}  // namespace scipd::daemon
