// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/bridge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include "daemon/device/rare_codes.h"

namespace scipd::daemon {
namespace {

constexpr float max_intensity = (1U << 18U) - 1;

std::uint32_t intensity_on_wire(const sim::Reading& reading) {
    return static_cast<std::uint32_t>(std::min(reading.intensity, max_intensity) + 0.5F);
}

/// Nothing where the model has no code of its own.
std::optional<std::uint32_t> own_code(sim::Cause cause, const protocol::DistanceCodes& codes) {
    switch (cause) {
        case sim::Cause::too_dark:
            return codes.too_dark;
        case sim::Cause::too_bright:
            return codes.too_bright;
        case sim::Cause::edge:
            return codes.edge;
        case sim::Cause::interference:
            return codes.interference;
        case sim::Cause::lost:
            return codes.lost;
        case sim::Cause::measured:
        case sim::Cause::nothing:
            break;
    }
    return std::nullopt;
}

std::uint32_t on_wire(const sim::Reading& reading, const protocol::DeviceProfile& profile) {
    if (reading.cause == sim::Cause::measured) return distance_on_wire(reading.range_m, profile);
    return own_code(reading.cause, profile.codes).value_or(profile.codes.nothing);
}

protocol::StepEchoes on_wire(std::span<const sim::Reading> readings,
                             const protocol::DeviceProfile& profile) {
    protocol::StepEchoes step{.count = static_cast<int>(readings.size())};
    for (std::size_t i = 0; i < readings.size(); ++i)
        step.echo[i] = {on_wire(readings[i], profile), intensity_on_wire(readings[i])};
    return step;
}

}  // namespace

protocol::ScanView WireScan::view() const {
    return {.turn = turn,
            .first_step = first_step,
            .distance = distance,
            .intensity = intensity,
            .echoes = echoes};
}

std::uint32_t distance_on_wire(float range_m, const protocol::DeviceProfile& profile) {
    if (!std::isfinite(range_m)) return profile.codes.nothing;
    // What rounds to a distance that is reported. Compared before it is rounded: a conversion is
    // several times faster than llround().
    constexpr double mm_per_m = 1000.0;
    const double distance_mm = double{range_m} * mm_per_m;
    if (distance_mm < profile.nearest_mm - 0.5) return profile.codes.too_near;
    if (distance_mm >= profile.dmax_mm + 0.5) return profile.codes.too_far;
    return static_cast<std::uint32_t>(distance_mm + 0.5);
}

WireScan to_wire(const sim::Scan& scan, const protocol::Turn& turn, const sim::SensorSpec& optics,
                 const protocol::DeviceProfile& profile) {
    WireScan wire{.turn = turn, .first_step = optics.first_step};
    wire.distance.resize(scan.readings.size());
    wire.intensity.resize(scan.readings.size());
    for (std::size_t beam = 0; beam < scan.readings.size(); ++beam) {
        wire.distance[beam] = on_wire(scan.readings[beam], profile);
        wire.intensity[beam] = intensity_on_wire(scan.readings[beam]);
    }
    if (!profile.rare_codes.empty()) put_rare_codes(scan.readings, profile, wire.distance);
    wire.echoes.reserve(scan.every_echo.beams());
    for (std::size_t beam = 0; beam < scan.every_echo.beams(); ++beam) {
        // A beam that another scanner disturbs has no echoes to tell.
        const bool disturbed = scan.readings[beam].cause == sim::Cause::interference;
        const std::span<const sim::Reading> one(&scan.readings[beam], 1);
        wire.echoes.push_back(on_wire(disturbed ? one : scan.every_echo[beam], profile));
    }
    return wire;
}

void put_changed(std::span<const sim::Reading> before, std::span<const sim::Reading> now,
                 const protocol::DeviceProfile& profile, WireScan& wire) {
    for (std::size_t beam = 0; beam < before.size(); ++beam) {
        if (now[beam] == before[beam]) continue;
        wire.distance[beam] = on_wire(now[beam], profile);
        wire.intensity[beam] = intensity_on_wire(now[beam]);
        if (!wire.echoes.empty()) wire.echoes[beam] = on_wire(now.subspan(beam, 1), profile);
    }
}

}  // namespace scipd::daemon
