// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A product: what it is on the wire and what its optics are. Data; no thread rule.
#pragma once

#include <vector>

#include "protocol/device_profile.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::daemon {

struct Model {
    protocol::DeviceProfile profile;
    sim::SensorSpec optics;
};

/// The optics follow from what the device says of itself (PP) but for how well it sees.
Model make_model(const protocol::DeviceProfile& profile, std::vector<sim::NoiseStep> noise);

}  // namespace scipd::daemon
