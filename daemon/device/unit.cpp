// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/unit.h"

#include <cctype>
#include <cmath>

#include "sim/fnv1a.h"
#include "sim/sensor/unit_bias.h"

namespace scipd::daemon {
namespace {

// Assumed: crystals are within some 10 ppm, and turns of real ones (25.05 ms where 25 is nominal)
// are farther off than that.
constexpr double typical_clock_ppm = 20.0;
constexpr double typical_turn_ppm = 300.0;

/// Which chances of a unit are for what. Its bias takes those before (unit_bias.cpp).
enum : std::uint32_t { first_digit = 64, clock_chance = 128, turn_chance };

/// The number of a unit that somebody saw, with other digits behind its first three characters,
/// which tell the line and the year. hokuyo_node looks at the first one.
std::string serial_like(std::string serial, const sim::Chance& chance) {
    constexpr std::size_t line_and_year = 3;
    for (std::size_t i = line_and_year; i < serial.size(); ++i) {
        if (std::isdigit(static_cast<unsigned char>(serial[i])) == 0) continue;
        const double even = chance.even(first_digit + static_cast<std::uint32_t>(i));
        serial[i] = static_cast<char>('0' + static_cast<int>(5.0 * (even + 1.0)));
    }
    return serial;
}

}  // namespace

Unit::Unit(const SensorConfig& config, const sim::ChanceKey& chance) {
    sim::ChanceKey key = chance;
    key.purpose = sim::Purpose::unit;
    const std::string& given = config.model.profile.serial;
    serial = config.model.own_serial ? given : serial_like(given, sim::Chance(key));
    number = sim::fnv1a<std::uint64_t>(serial);
    if (!config.interference || config.clock.ppm) return;
    const sim::Chance own({.seed = number, .purpose = sim::Purpose::unit});
    clock_ppm = typical_clock_ppm * own.standard_normal(clock_chance);
    turn_ppm = typical_turn_ppm * own.standard_normal(turn_chance);
}

std::chrono::nanoseconds Unit::turn(std::chrono::nanoseconds nominal) const {
    const double longer = static_cast<double>(nominal.count()) * turn_ppm * 1e-6;
    return nominal + std::chrono::nanoseconds(std::llround(longer));
}

sim::SensorSpec Unit::optics(const SensorConfig& config) const {
    sim::SensorSpec optics = config.model.optics;
    optics.scan_period = turn(optics.scan_period);
    if (config.model.own_bias) return optics;
    optics.bias = sim::unit_bias(optics, number);
    optics.receiver.walk_m = sim::unit_walk_m(optics, number);
    return optics;
}

sim::Scanner Unit::scanner(const SensorConfig& config, const protocol::DeviceProfile& profile,
                           const sim::ChanceKey& chance) const {
    return {optics(config),
            {.accuracy = config.accuracy,
             .seed = chance.seed,
             .sensor = chance.sensor,
             .choice = config.echo,
             .tells_every_echo = profile.multi_echo,
             .codes_vary = !profile.rare_codes.empty(),
             .noise_factor = config.noise}};
}

}  // namespace scipd::daemon
