// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/step_map.h"

#include <cmath>

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

Places by_angles(const sim::RecordedScan& scan, const sim::SensorSpec& optics) {
    const double first_rad = *scan.directions.first_rad;
    const double increment_rad = *scan.directions.increment_rad;
    Places places;
    for (int step = optics.first_step; step <= optics.last_step; ++step)
        places.push_back(
            within((optics.angle_rad(step) - first_rad) / increment_rad, scan.steps()));
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
