// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One scanner among all of its model: its serial number, and what differs from one unit to the
// next. All of it follows from that number, so a scanner with another seed is the same unit if its
// serial number is given. A value; any thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "daemon/config/sensor_config.h"
#include "protocol/device_profile.h"
#include "sim/random.h"
#include "sim/sensor/scanner.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::daemon {

struct Unit {
    /// `chance`: of the sensor. A serial number that nobody gives follows from it.
    Unit(const SensorConfig& config, const sim::ChanceKey& chance);

    std::string serial;
    std::uint64_t number;  ///< what stands for the serial number where chance needs one
    /// How much too fast its clock runs, and how much too long its turns are, where other scanners
    /// may disturb it: so that the mirrors of two drift apart. 0 where none may or its clock is
    /// given: then both are the model's.
    double clock_ppm = 0.0;
    double turn_ppm = 0.0;

    [[nodiscard]] std::chrono::nanoseconds turn(std::chrono::nanoseconds nominal) const;

    /// Those of the model, with what this unit reads too far.
    [[nodiscard]] sim::SensorSpec optics(const SensorConfig& config) const;
    /// What reads with these optics. `chance`: of the sensor.
    [[nodiscard]] sim::Scanner scanner(const SensorConfig& config,
                                       const protocol::DeviceProfile& profile,
                                       const sim::ChanceKey& chance) const;
};

}  // namespace scipd::daemon
