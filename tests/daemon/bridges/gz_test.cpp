// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is published by Gazebo's own transport, under the names of either generation.
#include <chrono>
#include <cstdlib>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "daemon/bridges/bus.h"
#include "tests/daemon/bridges/gz_bytes.h"
#include "tests/daemon/bridges/gz_publisher.h"
#include "tests/daemon/bridges/heard_by.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using namespace scipd::tests;
using ::testing::HasSubstr;

class GzTest : public testing::Test {
  protected:
    GzTest() { keep_gz_to_this_test(); }
    Kept kept_;
};

TEST_F(GzTest, HearsTheNamesOfEitherGeneration) {
    for (const std::string type : {"gz.msgs.Pose_V", "ignition.msgs.Pose_V"}) {
        Kept kept;
        GzPublisher publisher("/world/hall/dynamic_pose/info", type);
        const auto bus = listen_to_gz({"/world/hall/dynamic_pose/info"}, kept);
        ASSERT_TRUE(publisher.is_heard());
        for (int i = 0; i < 20; ++i)
            publisher.write(gz_poses(i * 10ms + 1s, {{"crate", 8, 0.1 * i}}));
        ASSERT_TRUE(kept.wait_for(20)) << kept.messages().size();
        EXPECT_EQ(kept.messages().size(), 20U);
        EXPECT_EQ(kept.messages().back().type, type);
        EXPECT_EQ(kept.messages().back().poses[0].time, 1190ms);
    }
}

TEST_F(GzTest, TellsWhichTopicsThereAreInPlaceOfTheOneThatIsNot) {
    GzPublisher publisher("/world/hall/pose/info", "gz.msgs.Pose_V");
    GzPublisher scans("/scan", "gz.msgs.LaserScan");
    const auto bus = listen_to_gz({"/world/hall/poses/info"}, kept_);
    ASSERT_TRUE(kept_.wait_for_trouble());
    EXPECT_EQ(kept_.trouble(),
              "no publisher of /world/hall/poses/info; did you mean '/world/hall/pose/info'?");
    Kept of_scans;
    const auto another = listen_to_gz({"/scan"}, of_scans);
    ASSERT_TRUE(of_scans.wait_for_trouble());
    EXPECT_THAT(of_scans.trouble(), HasSubstr("/scan is of gz.msgs.LaserScan"));
}

TEST_F(GzTest, RefusesDamagedMessagesAndGoesOn) {
    GzPublisher publisher("/poses", "gz.msgs.Pose_V");
    const auto bus = listen_to_gz({"/poses"}, kept_);
    ASSERT_TRUE(publisher.is_heard());
    publisher.write("damaged");
    publisher.write(gz_poses(1s, {{"crate", 8, 1.0}}));
    ASSERT_TRUE(kept_.wait_for(1, 1));
}

}  // namespace
}  // namespace scipd::daemon
