// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/bridge.h"

#include <algorithm>
#include <cmath>

namespace scipd::daemon {
namespace {

constexpr std::uint32_t max_intensity = (1U << 18U) - 1;

// Of a matt face seen head-on: what comes back falls with the square of the distance and with the
// cosine of the incidence (radar equation for an extended Lambertian target). The scale is assumed:
// it gives a wall at 2 m the 2500 that a recorded UTM-30LX shows indoors. Nearer than half a metre
// a scanner's gain control holds it level.
std::uint32_t intensity_on_wire(const sim::Hit& hit) {
    if (!hit.met()) return 0;
    constexpr float at_one_metre = 10000.0F;
    constexpr float level_below_m = 0.5F;
    const float range_m = std::max(hit.range_m, level_below_m);
    const float intensity = at_one_metre * hit.cos_incidence / (range_m * range_m);
    return std::min(static_cast<std::uint32_t>(std::lround(intensity)), max_intensity);
}

}  // namespace

protocol::ScanView WireScan::view() const {
    return {.turn = turn, .first_step = first_step, .distance = distance, .intensity = intensity};
}

std::uint32_t distance_on_wire(float range_m, const protocol::DeviceProfile& profile) {
    if (!std::isfinite(range_m)) return profile.codes.nothing;
    constexpr double mm_per_m = 1000.0;
    const long long distance_mm = std::llround(static_cast<double>(range_m) * mm_per_m);
    if (distance_mm < profile.nearest_mm) return profile.codes.too_near;
    if (distance_mm > profile.dmax_mm) return profile.codes.too_far;
    return static_cast<std::uint32_t>(distance_mm);
}

WireScan to_wire(const sim::Scan& scan, const protocol::Turn& turn, const sim::SensorSpec& optics,
                 const protocol::DeviceProfile& profile) {
    WireScan wire{.turn = turn, .first_step = optics.first_step};
    wire.distance.reserve(scan.range_m.size());
    wire.intensity.reserve(scan.hits.size());
    for (const float range_m : scan.range_m)
        wire.distance.push_back(distance_on_wire(range_m, profile));
    for (const sim::Hit& hit : scan.hits)
        wire.intensity.push_back(intensity_on_wire(hit));
    return wire;
}

}  // namespace scipd::daemon
