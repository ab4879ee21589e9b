// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is counted of a rig, which is all sensors of this daemon, for those who watch over it. A
// value; any thread.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "daemon/device/sensor_counts.h"

namespace scipd::daemon {

struct SensorMetrics {
    std::string name;           ///< "rescue/front"
    std::uint64_t clients = 0;  ///< connected now
    SensorCounts counts;        ///< also of its predecessors of the same name
};

struct RigMetrics {
    std::uint64_t poses = 0;
    std::uint64_t poses_refused = 0;
    std::map<std::string, std::uint64_t> limited;  ///< how often something was too much, by limit
    std::vector<SensorMetrics> sensors;
};

}  // namespace scipd::daemon
