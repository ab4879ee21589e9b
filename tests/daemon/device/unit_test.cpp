// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/unit.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

SensorConfig beside_others(std::optional<double> ppm = std::nullopt) {
    SensorConfig config = ideal_sensor();
    config.interference = true;
    config.clock.ppm = ppm;
    return config;
}

Unit unit_of(const SensorConfig& config, std::uint64_t sensor = 1, std::uint64_t seed = 1) {
    return {config, {.seed = seed, .sensor = sensor}};
}

SensorConfig with_serial(SensorConfig config, const std::string& serial) {
    config.model.profile.serial = serial;
    config.model.own_serial = true;
    return config;
}

TEST(Unit, HasAClockAndAMotorOfItsOwn) {
    constexpr int units = 2000;
    double clock = 0.0;
    double clock_squares = 0.0;
    double turn = 0.0;
    double turn_squares = 0.0;
    for (int i = 0; i < units; ++i) {
        const Unit unit = unit_of(beside_others(), static_cast<std::uint64_t>(i));
        clock += unit.clock_ppm / units;
        clock_squares += unit.clock_ppm * unit.clock_ppm / units;
        turn += unit.turn_ppm / units;
        turn_squares += unit.turn_ppm * unit.turn_ppm / units;
    }
    EXPECT_NEAR(clock, 0.0, 2.0);
    EXPECT_NEAR(turn, 0.0, 30.0);
    EXPECT_NEAR(std::sqrt(clock_squares), 20.0, 2.0);
    EXPECT_NEAR(std::sqrt(turn_squares), 300.0, 30.0);
}

TEST(Unit, FollowsFromItsSerialNumber) {
    const SensorConfig given = with_serial(beside_others(), "H1234567");
    const Unit one = unit_of(given, 1, 1);
    const Unit same = unit_of(given, 2, 2);
    EXPECT_EQ(one.serial, "H1234567");
    EXPECT_EQ(one.clock_ppm, same.clock_ppm);
    EXPECT_EQ(one.turn_ppm, same.turn_ppm);
    const Unit other = unit_of(with_serial(beside_others(), "H1234568"));
    EXPECT_NE(one.clock_ppm, other.clock_ppm);
    EXPECT_NE(one.turn_ppm, other.turn_ppm);
}

TEST(Unit, TurnsAsItsModelWhereNobodyDisturbsItOrItsClockIsGiven) {
    SensorConfig alone = beside_others();
    alone.interference = false;
    for (const SensorConfig& config : {alone, beside_others(0.0), beside_others(40.0)}) {
        const Unit unit = unit_of(config);
        EXPECT_EQ(unit.clock_ppm, 0.0);
        EXPECT_EQ(unit.turn_ppm, 0.0);
        EXPECT_EQ(unit.turn(25ms), 25ms);
    }
}

TEST(Unit, TakesSomePartsPerMillionLongerForATurn) {
    Unit unit = unit_of(beside_others());
    unit.turn_ppm = 100.0;
    EXPECT_EQ(unit.turn(25ms), 25ms + 2'500ns);
}

}  // namespace
}  // namespace scipd::daemon
