// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/scanner.h"

#include <cassert>
#include <utility>

namespace scipd::sim {

Scanner::Scanner(SensorSpec spec, const ErrorModel& errors)
    : spec_(std::move(spec)), pattern_(spec_), errors_(errors) {}

SharedScan Scanner::measure(RangeBackend& backend, std::int64_t revolution, Time start,
                            std::vector<Pose> world_from_sensor) const {
    const auto beams = pattern_.directions().size();
    const auto scan = std::make_shared<Scan>();
    scan->revolution = revolution;
    scan->start = start;
    scan->world_from_sensor = std::move(world_from_sensor);
    scan->hits.resize(beams);
    scan->range_m.resize(beams);
    backend.cast({.directions = pattern_.directions(),
                  .world_from_sensor = scan->world_from_sensor,
                  .max_range_m = static_cast<float>(spec_.max_range_m)},
                 scan->hits);
    errors_.read(spec_, revolution, scan->hits, scan->range_m);
    return scan;
}

}  // namespace scipd::sim
