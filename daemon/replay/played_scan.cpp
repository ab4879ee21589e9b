// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/replay/played_scan.h"

#include <cstddef>
#include <optional>

namespace scipd::daemon {
namespace {

sim::Cause cause_of(std::uint32_t distance, const protocol::DeviceProfile& profile) {
    const protocol::DistanceCodes& codes = profile.codes;
    if (distance == codes.too_dark) return sim::Cause::too_dark;
    if (distance == codes.too_bright) return sim::Cause::too_bright;
    if (distance == codes.edge) return sim::Cause::edge;
    if (distance == codes.interference) return sim::Cause::interference;
    if (distance == codes.lost) return sim::Cause::lost;
    const auto nearest = static_cast<std::uint32_t>(profile.nearest_mm);
    const auto farthest = static_cast<std::uint32_t>(profile.dmax_mm);
    const bool is_range = distance >= nearest && distance <= farthest;
    return is_range ? sim::Cause::measured : sim::Cause::nothing;
}

sim::Reading reading_of(const protocol::Echo& echo, const protocol::DeviceProfile& profile) {
    constexpr float m_per_mm = 1e-3F;
    sim::Reading reading{.intensity = static_cast<float>(echo.intensity),
                         .cause = cause_of(echo.distance, profile)};
    if (reading.cause == sim::Cause::measured)
        reading.range_m = m_per_mm * static_cast<float>(echo.distance);
    return reading;
}

}  // namespace

sim::Scan played_scan(const TapedScan& taped, const protocol::DeviceProfile& profile,
                      std::int64_t revolution, sim::Time start,
                      const sim::Pose& world_from_sensor) {
    sim::Scan scan{.revolution = revolution,
                   .start = start,
                   .world_from_sensor = {world_from_sensor},
                   .posed_at = {start}};
    const std::size_t steps = taped.distance.size();
    scan.hits.resize(steps);
    for (std::size_t step = 0; step < steps; ++step)
        scan.readings.push_back(reading_of({taped.distance[step], taped.intensity[step]}, profile));
    return scan;
}

}  // namespace scipd::daemon
