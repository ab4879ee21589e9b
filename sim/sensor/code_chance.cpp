// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/code_chance.h"

#include <cstddef>
#include <cstdint>
#include <limits>

namespace scipd::sim {

void draw_code_chances(ChanceKey key, std::span<Reading> readings) {
    constexpr double values = std::numeric_limits<std::uint16_t>::max() + 1.0;
    key.purpose = Purpose::code;
    const Chance chance(key);
    std::size_t drawn = readings.size();
    std::uint16_t of_group = 0;
    for (std::size_t beam = 0; beam < readings.size(); ++beam) {
        if (readings[beam].cause == Cause::measured) continue;
        const std::size_t group = beam / code_group;
        if (group != drawn) {
            const double share = 0.5 * (1.0 + chance.even(static_cast<std::uint32_t>(group)));
            of_group = static_cast<std::uint16_t>(share * values);
            drawn = group;
        }
        readings[beam].chance = of_group;
    }
}

}  // namespace scipd::sim
