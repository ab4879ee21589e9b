// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "testing/scipd_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace scipd::testing {
namespace {

std::size_t step_at(const std::vector<double>& angles_rad, double angle_rad) {
    const auto distance = [&](double angle) { return std::abs(angle - angle_rad); };
    const auto found = std::ranges::min_element(angles_rad, {}, distance);
    const double step_rad = angles_rad.size() > 1 ? std::abs(angles_rad[1] - angles_rad[0])
                                                  : std::numeric_limits<double>::infinity();
    if (found == angles_rad.end() || distance(*found) > step_rad)
        throw std::out_of_range("the sensor does not look to " + std::to_string(angle_rad) +
                                " rad");
    return static_cast<std::size_t>(found - angles_rad.begin());
}

std::optional<std::size_t> nearest_of(const std::vector<std::optional<double>>& ranges_m) {
    std::optional<std::size_t> nearest;
    for (std::size_t i = 0; i < ranges_m.size(); ++i) {
        if (ranges_m[i] && (!nearest || *ranges_m[i] < *ranges_m[*nearest])) nearest = i;
    }
    return nearest;
}

std::optional<Seen> seen_of(const Truth& truth, std::size_t i) {
    if (!truth.ranges_m[i]) return std::nullopt;
    const double angle_rad =
        truth.angles_rad.empty() ? std::numeric_limits<double>::quiet_NaN() : truth.angles_rad[i];
    return Seen{*truth.ranges_m[i], angle_rad, truth.objects[i], truth.materials[i]};
}

}  // namespace

std::optional<double> Scan::at(double angle_rad) const {
    return ranges_m[step_at(angles_rad, angle_rad)];
}

std::optional<Seen> Scan::nearest() const {
    const auto i = nearest_of(ranges_m);
    return i ? std::optional(Seen{*ranges_m[*i], angles_rad[*i], {}, {}}) : std::nullopt;
}

std::optional<Seen> Truth::at(double angle_rad) const {
    return seen_of(*this, step_at(angles_rad, angle_rad));
}

std::optional<Seen> Truth::nearest() const {
    const auto i = nearest_of(ranges_m);
    return i ? seen_of(*this, *i) : std::nullopt;
}

}  // namespace scipd::testing
