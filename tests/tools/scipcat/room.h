// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A room whose distances can be written down: walls 4 m ahead, 2 m behind and 3 m to both sides,
// with a door to the left that nothing returns from.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "protocol/device_profile.h"
#include "tests/support/loopback_scanner.h"

namespace scipd::tests {

inline double angle_rad(const protocol::DeviceProfile& profile, int step) {
    return (step - profile.afrt) * 2.0 * std::numbers::pi / profile.ares;
}

inline bool in_door(double angle) {
    return angle > 1.4 && angle < 1.7;
}

inline double room_range_m(double angle) {
    const double across = std::cos(angle);
    const double left = std::abs(std::sin(angle));
    const double to_end = (across > 0.0 ? 4.0 : 2.0) / std::max(std::abs(across), 1e-9);
    return std::min(to_end, 3.0 / std::max(left, 1e-9));
}

/// Intensities are the steps.
inline Reading room_reading(const protocol::DeviceProfile& profile, int step) {
    const double angle = angle_rad(profile, step);
    const auto distance = static_cast<std::uint32_t>(std::lround(1000.0 * room_range_m(angle)));
    return {.distance_mm = in_door(angle) ? profile.codes.nothing : distance,
            .intensity = static_cast<std::uint32_t>(step)};
}

/// How many steps have a distance.
inline int room_points(const protocol::DeviceProfile& profile) {
    int points = 0;
    for (int step = profile.amin; step <= profile.amax; ++step)
        points += in_door(angle_rad(profile, step)) ? 0 : 1;
    return points;
}

class RoomScanner : public LoopbackScanner {
  public:
    explicit RoomScanner(const protocol::DeviceProfile& profile)
        : LoopbackScanner(profile, [profile](int step) { return room_reading(profile, step); }) {}
};

}  // namespace scipd::tests
