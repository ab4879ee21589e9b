// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A test with a scanner of its own, which fails in the middle of it. It runs where scenes/ is:
//   cd /usr/share/scipd && SCIPD_KEEP=/tmp wall_test
#include <gtest/gtest.h>
#include <testing/scipd_test.h>

using scipd::testing::Box;
using WallTest = scipd::testing::ScipdTest;

TEST_F(WallTest, SeesWhatIsThere) {
    auto& scipd = start({.world = "scenes/square_room.sdf", .accuracy = "ideal"});
    EXPECT_EQ(scipd.scan().at(0), 3.0);   // a driver would get this, straight ahead
    scipd.robot().set_pose({1, 0.5, 0});  // x, y, yaw: metres and radians
    scipd.scene().add("crate", Box{{0.4, 0.4, 0.4}}, {2, 0.5, 0});
    EXPECT_EQ(scipd.truth().nearest()->object, "crate::body::box");
    scipd.fault("stall", {{"seconds", 2}});
    EXPECT_THROW((void)scipd.scan({}, std::chrono::seconds(1)), scipd::testing::NoScan);
}
