// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/air_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace scipd::sim {
namespace {

/// So that the beams of several media do not share their chance.
constexpr std::uint32_t media_apart = 1U << 20U;

/// Where the beam is within the box, from and to; from > to: nowhere.
std::pair<double, double> within(const Medium& medium, const glm::dvec3& from_m,
                                 const glm::dvec3& direction) {
    double enters = 0.0;
    double leaves = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double low = medium.low_m[axis] - from_m[axis];
        const double high = medium.high_m[axis] - from_m[axis];
        if (direction[axis] == 0.0) {
            if (low > 0.0 || high < 0.0) return {1.0, 0.0};
            continue;
        }
        const auto [near, far] = std::minmax({low / direction[axis], high / direction[axis]});
        enters = std::max(enters, near);
        leaves = std::min(leaves, far);
    }
    return {enters, leaves};
}

}  // namespace

AirPath::AirPath(std::span<const Medium> media, const glm::dvec3& from_m,
                 const glm::dvec3& direction) {
    for (std::uint32_t i = 0; i < media.size(); ++i) {
        const auto [enters, leaves] = within(media[i], from_m, direction);
        if (enters < leaves) stretches_.push_back({&media[i], i, enters, leaves});
    }
}

double AirPath::left(double range_m) const {
    double exponent = 0.0;
    for (const Stretch& stretch : stretches_) {
        const double gone_m = std::min(range_m, stretch.to_m) - stretch.from_m;
        exponent += stretch.medium->extinction_per_m * std::max(0.0, gone_m);
    }
    return std::exp(-2.0 * exponent);
}

std::vector<AirPath::Drop> AirPath::drops(double range_m, const Chance& chance,
                                          std::uint32_t beam) const {
    std::vector<Drop> met;
    for (const Stretch& stretch : stretches_) {
        if (stretch.medium->returns_per_m <= 0.0) continue;
        const double even = 0.5 * (1.0 + chance.even(beam + stretch.index * media_apart));
        const double at_m = stretch.from_m - std::log(even) / stretch.medium->returns_per_m;
        if (at_m < std::min(range_m, stretch.to_m))
            met.push_back({at_m, stretch.medium->brightness});
    }
    return met;
}

}  // namespace scipd::sim
