// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <span>
#include <string>

#include "sim/world/scene.h"

namespace scipd::sim {
struct Scan;
}

namespace scipd::daemon {

/// What the beams of a sensor have met, before noise is added. A view that is good for one call.
struct Cast {
    const std::string& robot;
    const std::string& sensor;
    const sim::Scan& scan;
    bool looks_around;                            ///< over half a turn or more
    std::span<const sim::ObjectId> housing = {};  ///< of the sensor, which its beams pass through
};

}  // namespace scipd::daemon
