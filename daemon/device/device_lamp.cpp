// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scanner as others see it: a light that turns with its mirror.
#include <chrono>
#include <cmath>

#include "daemon/device/device.h"

namespace scipd::daemon {

std::optional<LampBeam> Device::shines(sim::Time time) const {
    if (!state_.laser_on()) return std::nullopt;
    const sim::Time device_time = device_clock_.device_time(time);
    const std::int64_t revolution = timing_.revolution_at(device_time);
    const std::chrono::duration<double> since = device_time - timing_.start(revolution);
    const std::chrono::duration<double> turn =
        timing_.start(revolution + 1) - timing_.start(revolution);
    const sim::SensorSpec& optics = sweep_.optics();
    const double step = optics.steps_per_turn * (since / turn);
    if (step < optics.first_step || step > optics.last_step) return std::nullopt;
    const double angle_rad = optics.angle_rad(step);
    const sim::Pose pose = sweep_.pose_at(time);
    return LampBeam{pose.translation_m,
                    pose.rotation * glm::dvec3{std::cos(angle_rad), std::sin(angle_rad), 0.0},
                    optics.footprint.half_width_rad};
}

}  // namespace scipd::daemon
