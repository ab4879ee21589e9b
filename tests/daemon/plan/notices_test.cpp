// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/notices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/models/model_registry.h"

namespace scipd::daemon {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Three scanners, the serial numbers of two of which were given.
Config three(const std::string& front, const std::string& rear) {
    Config config;
    config.robots.resize(1);
    config.robots[0].name = "robot";
    for (const char* const name : {"front", "middle", "rear"}) {
        SensorConfig& sensor = config.robots[0].sensors.emplace_back();
        sensor.name = name;
        sensor.model = find_model("UST-10LX");
    }
    const auto give = [&](std::size_t sensor, const std::string& serial) {
        config.robots[0].sensors[sensor].model.profile.serial = serial;
        config.robots[0].sensors[sensor].model.own_serial = true;
    };
    give(0, front);
    give(2, rear);
    return config;
}

TEST(SharedSerials, AreTold) {
    EXPECT_THAT(serial_notices(three("H1", "H1"), {}),
                ElementsAre("robot/front and robot/rear have the serial number H1, so they are one "
                            "unit and have the same bias; give each its own, with serial under "
                            "profile, or none"));
}

// Without one each has the number that a recorded unit had, and draws its own from it.
TEST(SharedSerials, AreNoneWhereTheyWereNotGivenOrDiffer) {
    EXPECT_THAT(serial_notices(three("H1", "H2"), {}), IsEmpty());
    const std::string recorded = find_model("UST-10LX").profile.serial;
    EXPECT_THAT(serial_notices(three("H1", recorded), {}), IsEmpty());
}

TEST(SharedSerials, AreNobodysMistakeWhereTheBiasIsGiven) {
    Config config = three("H1", "H1");
    config.robots[0].sensors[2].model.own_bias = true;
    EXPECT_THAT(serial_notices(config, {}), IsEmpty());
}

TEST(SharedSerials, AreToldOnce) {
    const Config config = three("H1", "H1");
    KnownSensors running;
    for (const SensorConfig& sensor : config.robots[0].sensors)
        running["robot/" + sensor.name].config = sensor;
    EXPECT_THAT(serial_notices(config, running), IsEmpty());
    running.erase("robot/rear");
    EXPECT_EQ(serial_notices(config, running).size(), 1U);
}

}  // namespace
}  // namespace scipd::daemon
