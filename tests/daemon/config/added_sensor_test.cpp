// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A configuration with one sensor more or less, and what is wrong with one that comes.
#include "daemon/config/added_sensor.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/config/config_file.h"
#include "daemon/config/saved_config.h"
#include "sim/loaders/file/load_error.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class AddedSensorTest : public testing::Test {
  protected:
    [[nodiscard]] std::vector<std::string> faults(const AddedSensor& added) const {
        try {
            (void)with_sensor(now_, added);
        } catch (const sim::LoadError& error) {
            return error.faults();
        }
        return {};
    }

    const tests::TempDir dir_;
    const std::string world_ = dir_.write("world.sdf", "");
    /// Two robots that share what one line says.
    const Config now_ = parse_config(
        "scene: world.sdf\n"
        "robots:\n"
        "  a: &same {pose: {xyz: [1, 2, 0]}, sensors: {front: {model: UST-10LX, tcp: "
        "\"127.0.0.1:10940\"}}}\n"
        "  b: {sensors: {front: {model: UST-20LX, pty: auto}}}\n",
        dir_.path() / "rig.yaml");
};

TEST_F(AddedSensorTest, IsAllThatIsNew) {
    const Config next =
        with_sensor(now_, {"a", "rear", R"({"model":"URG-04LX","pty":"auto"})", {}});
    ASSERT_EQ(next.robots.size(), 2U);
    ASSERT_EQ(next.robots[0].sensors.size(), 2U);
    EXPECT_EQ(next.robots[0].sensors[0], now_.robots[0].sensors[0]);
    EXPECT_EQ(next.robots[0].sensors[1].model.profile.name, "URG-04LX");
    EXPECT_EQ(next.robots[1], now_.robots[1]);
    const std::string saved = saved_config(next, "world.sdf");
    EXPECT_THAT(saved, HasSubstr("model: URG-04LX"));
    const Config back = without_sensor(next, "a", "rear");
    EXPECT_EQ(back.robots, now_.robots);
    EXPECT_EQ(saved_config(back, "world.sdf").find("rear"), std::string::npos);
}

TEST_F(AddedSensorTest, TakesItsRobotWithIt) {
    const Config less = without_sensor(now_, "b", "front");
    ASSERT_EQ(less.robots.size(), 1U);
    EXPECT_EQ(saved_config(less, "world.sdf").find("b:"), std::string::npos);
    const Config more =
        with_sensor(less, {"c", "s", "{model: UST-10LX, pty: auto}", "{xyz: [3, 4, 0]}"});
    ASSERT_EQ(more.robots.size(), 2U);
    EXPECT_EQ(more.robots[1].world_from_robot.translation_m, glm::dvec3(3, 4, 0));
}

TEST_F(AddedSensorTest, TellsEveryFaultByItsKey) {
    EXPECT_THAT(faults({"a", "rear", R"({"model":"URG-04LX","tcp":"127.0.0.1:10940"})", {}}),
                ElementsAre("tcp: 127.0.0.1:10940 is taken by robots.a.sensors.front.tcp; use "
                            "another"));
    EXPECT_THAT(faults({"c", "s", R"({"model":"URG-05LX","noise":-1})", "{xyz: [1]}"}),
                testing::UnorderedElementsAre(HasSubstr("model: there is no model"),
                                              HasSubstr("noise: "), HasSubstr("pose.xyz: "),
                                              HasSubstr("no driver could reach it")));
}

}  // namespace
}  // namespace scipd::daemon
