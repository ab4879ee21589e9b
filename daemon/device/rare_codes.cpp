// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/rare_codes.h"

#include <cstddef>

namespace scipd::daemon {
namespace {

using protocol::RareCode;
using sim::Cause;
using sim::Reading;

bool has_range(std::span<const Reading> readings, std::size_t beam) {
    return beam < readings.size() && readings[beam].cause == Cause::measured;
}

using Share = double RareCode::*;

/// Null where the cause has one code only.
Share share_at(std::span<const Reading> readings, std::size_t beam) {
    switch (readings[beam].cause) {
        case Cause::edge:
            return &RareCode::edge;
        case Cause::nothing:
        case Cause::too_dark:
            return (beam > 0 && has_range(readings, beam - 1)) || has_range(readings, beam + 1)
                       ? &RareCode::beside
                       : &RareCode::inside;
        default:
            return nullptr;
    }
}

/// The one that the chance chose for the beam's group, if any.
const RareCode* drawn(std::uint16_t chance, std::size_t beam, Share share,
                      std::span<const RareCode> rare_codes) {
    constexpr double values = 0x10000 / sim::code_group;
    const std::size_t place = chance % sim::code_group;  // of the group's code that stands alone
    double left = 1.0 - static_cast<double>(chance / sim::code_group) / values;
    for (const RareCode& rare : rare_codes) {
        left -= rare.*share * (rare.alone ? double{sim::code_group} : 1.0);
        if (left > 0.0) continue;
        return rare.alone && place != beam % sim::code_group ? nullptr : &rare;
    }
    return nullptr;
}

bool stands_alone(std::uint32_t code, std::span<const RareCode> rare_codes) {
    for (const RareCode& rare : rare_codes)
        if (rare.code == code && rare.alone) return true;
    return false;
}

}  // namespace

void put_rare_codes(std::span<const Reading> readings, const protocol::DeviceProfile& profile,
                    std::span<std::uint32_t> distance) {
    for (std::size_t beam = 0; beam < readings.size(); ++beam) {
        const Share share = share_at(readings, beam);
        if (share == nullptr) continue;
        if (const auto* rare = drawn(readings[beam].chance, beam, share, profile.rare_codes))
            distance[beam] = rare->code;
        const bool again = beam > 0 && distance[beam] == distance[beam - 1];
        if (again && stands_alone(distance[beam], profile.rare_codes))
            distance[beam] = profile.codes.nothing;
    }
}

}  // namespace scipd::daemon
