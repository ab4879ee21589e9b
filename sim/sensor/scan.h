// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One revolution as the sensor saw it: the true ranges and those that were read. It never changes
// once it is measured, and is shared by everyone who sends or inspects it. Any thread.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/backends/fan.h"
#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::sim {

struct Scan {
    std::int64_t revolution = 0;
    Time start{};                         ///< the instant of step 0
    std::vector<Pose> world_from_sensor;  ///< one, or one per beam
    std::vector<Time> posed_at;           ///< when it was at these poses; empty: unknown
    std::vector<Hit> hits;                ///< the truth, one per beam from first_step on
    std::vector<float> range_m;           ///< what the sensor read; infinity: nothing came back
};

using SharedScan = std::shared_ptr<const Scan>;

}  // namespace scipd::sim
