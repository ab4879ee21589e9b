// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/sensor_motion.h"

#include <vector>

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

TEST(SensorMotion, IsNoneOfOnePose) {
    const Pose pose = pose_from_rpy({1, 2, 3}, {0, 0, 0.5});
    const SensorMotion motion = motion_of({&pose, 1});
    EXPECT_EQ(motion.middle, pose);
    EXPECT_EQ(motion.moved_m, 0.0);
    EXPECT_NEAR(motion.turned_rad, 0.0, 1e-7);
}

// Ten steps of 0.1 m and 0.02 rad: the first pose is farther from the sixth than the last.
TEST(SensorMotion, IsThatFromTheMiddleToTheFarthest) {
    std::vector<Pose> poses;
    for (int i = 0; i < 10; ++i)
        poses.push_back(pose_from_rpy({0.1 * i, 7, 0}, {0, 0, 3.0 + 0.02 * i}));
    const SensorMotion motion = motion_of(poses);
    EXPECT_EQ(motion.middle, poses[5]);
    EXPECT_NEAR(motion.moved_m, 0.5, 1e-12);
    EXPECT_NEAR(motion.turned_rad, 0.1, 1e-9);
}

TEST(SensorMotion, SeesAJumpAndBack) {
    std::vector<Pose> poses(9);
    poses[2] = pose_from_rpy({0, 3, 4}, {0, 0, 2.0});
    EXPECT_NEAR(motion_of(poses).moved_m, 5.0, 1e-12);
    EXPECT_NEAR(motion_of(poses).turned_rad, 2.0, 1e-9);
}

}  // namespace
}  // namespace scipd::sim
