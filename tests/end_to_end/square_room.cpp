// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/end_to_end/square_room.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scipd::tests {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

struct Span {
    double near;
    double far;
};

// The part of a ray that lies between low and high on one axis.
Span between(double from, double direction, double low, double high) {
    if (std::abs(direction) < 1e-12) {
        return from > low && from < high ? Span{-none, none} : Span{none, -none};
    }
    const double a = (low - from) / direction;
    const double b = (high - from) / direction;
    return {std::min(a, b), std::max(a, b)};
}

Span intersection(const Span& a, const Span& b) {
    return {std::max(a.near, b.near), std::min(a.far, b.far)};
}

double to_pillar(const Planar& from, double dx, double dy) {
    constexpr double radius_m = 0.25;
    const double x = 1.5 - from.x_m;
    const double y = 1.5 - from.y_m;
    const double along = x * dx + y * dy;
    const double aside = x * dy - y * dx;
    if (along < 0.0 || std::abs(aside) >= radius_m) return none;
    return along - std::sqrt(radius_m * radius_m - aside * aside);
}

double to_box(const Planar& from, double dx, double dy) {
    const Span inside =
        intersection(between(from.x_m, dx, 1.5, 2.1), between(from.y_m, dy, -1.6, -1.0));
    return inside.near < inside.far && inside.near > 0.0 ? inside.near : none;
}

double to_walls(const Planar& from, double dx, double dy) {
    return intersection(between(from.x_m, dx, -3.0, 3.0), between(from.y_m, dy, -2.0, 2.0)).far;
}

}  // namespace

double range_in_square_room(const Planar& from, double bearing_rad) {
    const double dx = std::cos(from.yaw_rad + bearing_rad);
    const double dy = std::sin(from.yaw_rad + bearing_rad);
    return std::min({to_walls(from, dx, dy), to_pillar(from, dx, dy), to_box(from, dx, dy)});
}

std::optional<double> certain_range_in_square_room(const Planar& from, double bearing_rad) {
    constexpr double a_little_rad = 1e-4;
    constexpr double same_m = 1e-3;  // with the rounding of the scanner, what tests allow
    const double range_m = range_in_square_room(from, bearing_rad);
    for (const double aside_rad : {-a_little_rad, a_little_rad}) {
        if (std::abs(range_in_square_room(from, bearing_rad + aside_rad) - range_m) > same_m)
            return std::nullopt;
    }
    return range_m;
}

}  // namespace scipd::tests
