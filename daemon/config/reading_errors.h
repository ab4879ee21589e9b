// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How well a scanner reads: the part of its configuration that can change while its clients go on.
// Values; any thread.
#pragma once

#include <vector>

#include "daemon/config/sensor_config.h"

namespace scipd::daemon {

struct ReadingErrors {
    sim::Accuracy accuracy = sim::Accuracy::sensor;
    double noise = 1.0;  ///< so many times the model's
    bool interference = false;
    bool own_bias = false;  ///< false: it reads too far what its unit does, and bias is empty
    std::vector<sim::BiasPoint> bias;

    bool operator==(const ReadingErrors&) const = default;
};

[[nodiscard]] ReadingErrors errors_of(const SensorConfig& sensor);
void set_errors(SensorConfig& sensor, ReadingErrors errors);
}  // namespace scipd::daemon
