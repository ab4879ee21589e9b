// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// States as the VDA's own examples have them, and damaged ones.
#include "daemon/fleet/vda5050.h"

#include <cmath>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

const std::string state =
    R"({"headerId":7,"timestamp":"2025-01-31T12:00:01.25Z","version":"2.0.0",
 "manufacturer":"ACME","serialNumber":"tug-1","orderId":"",
 "nodeStates":[{"nodeId":"n1","sequenceId":0,
 "released":true,"nodePosition":{"x":1,"y":2,"mapId":"hall"}}],"edgeStates":[],"driving":true,
 "agvPosition":{"x":3.5,"y":-2,"theta":1.5707963267948966,"mapId":"hall","positionInitialized":true,
 "localizationScore":0.9},"velocity":{"vx":2.0,"vy":0.0,"omega":0.5},
 "batteryState":{"batteryCharge":80,"charging":false},"errors":[],"safetyState":{"eStop":"NONE"}})";

TEST(Vda5050, AStateIsAPose) {
    const auto line = parse_vda5050_state(state);
    ASSERT_TRUE(line) << line.error().why;
    EXPECT_EQ(line->pose.translation_m, glm::dvec3(3.5, -2.0, 0.0));
    EXPECT_NEAR(line->pose.rotation.w, std::cos(std::numbers::pi / 4.0), 1e-12);
    EXPECT_NEAR(line->pose.rotation.z, std::sin(std::numbers::pi / 4.0), 1e-12);
    // `date -d 2025-01-31T12:00:01Z +%s`
    EXPECT_EQ(line->time, sim::Time(1738324801s) + 250ms);
    ASSERT_TRUE(line->velocity);
    EXPECT_NEAR(line->velocity->linear_mps.x, 0.0, 1e-12);
    EXPECT_NEAR(line->velocity->linear_mps.y, 2.0, 1e-12);
    EXPECT_EQ(line->velocity->angular_radps.z, 0.5);
}

TEST(Vda5050, NothingButThePositionIsNeeded) {
    const auto line = parse_vda5050_state(R"({"agvPosition":{"x":1,"y":2,"theta":0}})");
    ASSERT_TRUE(line);
    EXPECT_FALSE(line->time);
    EXPECT_FALSE(line->velocity);
    for (const char* stamp : {"", "yesterday", "2025-13-01T00:00:00Z", "9999-01-01T00:00:00Z",
                              "2025-01-01T00:00:1e9Z"}) {
        const auto late = parse_vda5050_state(R"({"timestamp":")" + std::string(stamp) +
                                              R"(","agvPosition":{"x":1,"y":2,"theta":0}})");
        ASSERT_TRUE(late) << stamp;
        EXPECT_FALSE(late->time) << stamp;
    }
}

TEST(Vda5050, AVehicleThatIsLostIsRefused) {
    std::string lost = state;
    lost.replace(lost.find("Initialized\":true"), 17, "Initialized\":false");
    EXPECT_THAT(parse_vda5050_state(lost).error().why, HasSubstr("does not know where it is"));
    for (const char* bad :
         {"", "[]", "{}", R"({"agvPosition":3})", R"({"agvPosition":{"x":1,"y":2}})",
          R"({"agvPosition":{"x":"1","y":2,"theta":0}})",
          R"({"agvPosition":{"x":1e300,"y":2,"theta":0}})",
          R"({"agvPosition":{"x":1,"y":2,"theta":1e300}})"}) {
        EXPECT_FALSE(parse_vda5050_state(bad)) << bad;
    }
}

TEST(Vda5050, ATopicIsThatOfTheStandard) {
    EXPECT_EQ(vda5050_topic("ACME/tug-1", "east"), "uagv/v2/ACME/tug-1/state");
    EXPECT_EQ(vda5050_topic("ACME", "tug-1"), "uagv/v2/ACME/tug-1/state");
}

}  // namespace
}  // namespace scipd::daemon
