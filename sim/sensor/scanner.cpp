// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/scanner.h"

#include <cassert>
#include <utility>

namespace scipd::sim {

Scanner::Scanner(SensorSpec spec, const ErrorModel& errors)
    : spec_(std::move(spec)), pattern_(spec_), errors_(errors) {}

Scanner::Scanner(SensorSpec spec, BeamPattern pattern, const ErrorModel& errors)
    : spec_(std::move(spec)), pattern_(std::move(pattern)), errors_(errors) {
    assert(pattern_.directions().size() == static_cast<std::size_t>(spec_.beams()));
}

SharedScan Scanner::measure(RangeBackend& backend, std::int64_t revolution, Time start,
                            std::vector<Pose> world_from_sensor) const {
    Scan scan = begin(revolution, start, std::move(world_from_sensor));
    cast(backend, scan, {0, pattern_.directions().size()}, no_model);
    read(scan);
    return std::make_shared<const Scan>(std::move(scan));
}

Scan Scanner::begin(std::int64_t revolution, Time start,
                    std::vector<Pose> world_from_sensor) const {
    const auto beams = pattern_.directions().size();
    assert(world_from_sensor.size() == 1 || world_from_sensor.size() == beams);
    return {.revolution = revolution,
            .start = start,
            .world_from_sensor = std::move(world_from_sensor),
            .hits = std::vector<Hit>(beams),
            .range_m = std::vector<float>(beams)};
}

void Scanner::cast(RangeBackend& backend, Scan& scan, Beams beams, ModelId unseen,
                   std::optional<std::span<const ModelId>> can_meet) const {
    const auto [first, count] = beams;
    const std::span<const Pose> poses = scan.world_from_sensor;
    backend.cast({.directions = pattern_.directions().subspan(first, count),
                  .world_from_sensor = poses.size() == 1 ? poses : poses.subspan(first, count),
                  .max_range_m = static_cast<float>(spec_.max_range_m),
                  .unseen = unseen,
                  .can_meet = can_meet},
                 std::span(scan.hits).subspan(first, count));
}

void Scanner::read(Scan& scan) const {
    errors_.read(spec_, scan.revolution, scan.hits, scan.range_m);
}

}  // namespace scipd::sim
