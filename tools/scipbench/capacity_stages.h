// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the stages of a scan cost by themselves, in this process: the parts of scipd's work that
// can be measured without scipd. One thread.
#pragma once

#include <cstddef>
#include <vector>

#include "daemon/models/model.h"
#include "sim/backends/range_backend.h"
#include "sim/world/pose.h"

namespace scipd::tools {

/// Processor time of a scan, at accuracy `sensor`.
struct StageCosts {
    std::size_t rays = 0;
    double bare_cast_us = 0.0;  ///< all rays from one pose, and nothing else
    double poses_us = 0.0;      ///< where the scanner is when each beam is fired
    double cast_us = 0.0;       ///< all rays, from there
    double errors_us = 0.0;     ///< what the scanner reads of what the rays met
    double encode_us = 0.0;     ///< the message, from millimetres
};

/// Mean over these places (see on_its_lap).
StageCosts measure_stages(sim::RangeBackend& backend, const daemon::Model& model, bool driving,
                          const std::vector<sim::Pose>& places);

}  // namespace scipd::tools
