// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/homes.h"

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/config/config.h"
#include "daemon/plan/known_sensors.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

class HomesTest : public testing::Test {
  protected:
    HomesTest() { config_.robots.emplace_back().name = "robot"; }

    SensorConfig& add(const std::string& name) {
        SensorConfig sensor = ideal_sensor();
        sensor.name = name;
        return config_.robots[0].sensors.emplace_back(sensor);
    }
    /// Its sweeps have taken so long.
    void know(const SensorConfig& sensor, std::optional<std::chrono::duration<double>> sweep) {
        known_["robot/" + sensor.name] = {sensor, nullptr, sweep};
    }
    /// The shards of the sensors in their order, where none is held.
    [[nodiscard]] std::vector<std::size_t> homes() const {
        const Homes found = find_homes(config_, {.shards = 2}, known_);
        std::vector<std::size_t> shards;
        for (const SensorConfig& sensor : config_.robots[0].sensors)
            shards.push_back(found.sensors.at("robot/" + sensor.name));
        return shards;
    }

    Config config_;
    KnownSensors known_;
};

TEST_F(HomesTest, SpreadsByWhatWasMeasured) {
    for (const char* name : {"a", "b", "c", "d"})
        add(name);
    EXPECT_THAT(homes(), ElementsAre(0, 1, 0, 1));
    for (const SensorConfig& sensor : config_.robots[0].sensors)
        know(sensor, sensor.name == "c" ? 300us : 100us);
    EXPECT_THAT(homes(), ElementsAre(1, 1, 0, 1));
}

TEST_F(HomesTest, ForgetsWhatWasMeasuredOfAnotherConfiguration) {
    for (const char* name : {"a", "b", "c"})
        know(add(name), 100us);
    know(config_.robots[0].sensors[2], 300us);
    EXPECT_THAT(homes(), ElementsAre(1, 1, 0));
    config_.robots[0].sensors[2].accuracy = sim::Accuracy::sensor;
    EXPECT_THAT(homes(), ElementsAre(0, 1, 0));
}

// A footprint has seven rays.
TEST_F(HomesTest, CountsTheRaysOfWhatHasNotMeasuredYet) {
    for (const char* name : {"a", "b", "c", "d"})
        add(name);
    config_.robots[0].sensors[3].accuracy = sim::Accuracy::material;
    EXPECT_THAT(homes(), ElementsAre(1, 1, 1, 0));
    // A ray costs what it costs "a", so "d" costs seven times as much.
    for (const SensorConfig& sensor : config_.robots[0].sensors)
        know(sensor, sensor.name == "a" ? std::optional(700us) : std::nullopt);
    EXPECT_THAT(homes(), ElementsAre(1, 1, 1, 0));
    // A ray costs a third of that, as "b" and "c" take nothing; "d" has one a beam now.
    know(config_.robots[0].sensors[1], 0us);
    know(config_.robots[0].sensors[2], 0us);
    config_.robots[0].sensors[3].accuracy = sim::Accuracy::ideal;
    EXPECT_THAT(homes(), ElementsAre(0, 1, 1, 1));
}

TEST_F(HomesTest, LeavesThemWhereTheyAreWhateverTheyCost) {
    const Homes now{.shards = 2, .sensors = {{"robot/a", 1}, {"robot/b", 1}}, .ports = {}};
    know(add("a"), 100us);
    know(add("b"), 100us);
    add("c");
    const Homes found = find_homes(config_, now, known_);
    EXPECT_EQ(found.sensors.at("robot/a"), 1U);
    EXPECT_EQ(found.sensors.at("robot/b"), 1U);
    EXPECT_EQ(found.sensors.at("robot/c"), 0U);
}

TEST_F(HomesTest, BringsThoseTogetherThatDisturbEachOtherWhereNoneLivesElsewhere) {
    Homes now{.shards = 2};
    for (const char* name : {"a", "b"}) {
        know(add(name), 100us);
        now.sensors[std::string("robot/") + name] = 1;
    }
    config_.robots[0].sensors[0].interference = true;
    EXPECT_THROW((void)find_homes(config_, now, known_), std::runtime_error);
    for (const auto& [name, shard] : find_homes(config_, {.shards = 2}, known_).sensors)
        EXPECT_EQ(shard, 0U) << name;
}

}  // namespace
}  // namespace scipd::daemon
