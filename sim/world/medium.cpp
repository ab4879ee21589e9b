// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/medium.h"

#include <cmath>
#include <numbers>

namespace scipd::sim {
namespace {

double koschmieder_per_m(double visibility_m) {
    return 3.912 / visibility_m;
}

}  // namespace

Medium fog(double visibility_m) {
    constexpr double depth_m = 0.5;
    const double extinction_per_m = koschmieder_per_m(visibility_m);
    const double back_per_sr_m = 0.046 / visibility_m;
    return {.name = "fog",
            .extinction_per_m = extinction_per_m,
            .returns_per_m = extinction_per_m,
            .brightness = std::numbers::pi * back_per_sr_m * depth_m,
            .kind = "fog",
            .amount = visibility_m};
}

Medium rain(double mm_per_hour) {
    const double extinction_per_m = 3.65e-4 * std::pow(mm_per_hour, 0.63);
    return {.name = "rain",
            .extinction_per_m = extinction_per_m,
            .returns_per_m = extinction_per_m,
            .brightness = 0.02,
            .kind = "rain",
            .amount = mm_per_hour};
}

Medium snow(double mm_per_hour) {
    const double extinction_per_m = 1.44e-3 * std::pow(mm_per_hour, 0.57);
    return {.name = "snow",
            .extinction_per_m = extinction_per_m,
            .returns_per_m = extinction_per_m,
            .brightness = 0.1,
            .kind = "snow",
            .amount = mm_per_hour};
}

Medium dust(double visibility_m) {
    const double extinction_per_m = koschmieder_per_m(visibility_m);
    return {.name = "dust",
            .extinction_per_m = extinction_per_m,
            .returns_per_m = 0.2 * extinction_per_m,
            .brightness = 0.05,
            .kind = "dust",
            .amount = visibility_m};
}

}  // namespace scipd::sim
