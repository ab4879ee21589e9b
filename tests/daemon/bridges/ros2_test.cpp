// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is published by another vendor's DDS, over the network of this machine.
#include <chrono>
#include <cstdlib>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "daemon/bridges/bus.h"
#include "tests/daemon/bridges/fast_dds_publisher.h"
#include "tests/daemon/bridges/heard_by.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using namespace scipd::tests;
using ::testing::HasSubstr;

constexpr double half = 0.70710678118654757;

class Ros2Test : public testing::Test {
  protected:
    Ros2Test() {
        setenv("ROS_LOCALHOST_ONLY", "1", 1);
        setenv("ROS_DOMAIN_ID", std::to_string(domain_).c_str(), 1);
    }

    [[nodiscard]] static bool matched(const FastDdsPublisher& publisher, int count = 1) {
        // They find each other late where many tests run.
        for (int i = 0; i < 1000 && publisher.subscribers() != count; ++i)
            std::this_thread::sleep_for(50ms);
        return publisher.subscribers() == count;
    }

    static WrittenTransform at(std::int32_t sec, double x, const std::string& parent = "odom",
                               const std::string& child = "base_link") {
        return {sec, 500'000'000, parent, child, {x, 2.0, 0.5, 0.0, 0.0, half, half}};
    }

    // Tests that run side by side do not hear each other.
    int domain_ = 100 + static_cast<int>(getpid() % 100);
    Kept kept_;
};

TEST_F(Ros2Test, HearsAReliablePublisher) {
    FastDdsPublisher publisher(domain_, "/odom", "nav_msgs/Odometry");
    const auto bus = listen_to_ros2({.topic = "/odom"}, kept_);
    ASSERT_TRUE(matched(publisher));
    publisher.write(odometry_bytes(at(12, 1.0), {1.0, 0.0, 0.0, 0.0, 0.0, 0.25}));
    ASSERT_TRUE(kept_.wait_for(1));
    const Heard heard = kept_.messages().front();
    EXPECT_EQ(heard.type, "nav_msgs/Odometry");
    ASSERT_EQ(heard.poses.size(), 1U);
    const HeardPose& pose = heard.poses.front();
    EXPECT_EQ(pose.parent, "odom");
    EXPECT_EQ(pose.child, "base_link");
    EXPECT_EQ(pose.time, 12500ms);
    EXPECT_EQ(pose.parent_from_child.translation_m, glm::dvec3(1.0, 2.0, 0.5));
    EXPECT_DOUBLE_EQ(pose.parent_from_child.rotation.z, half);
    // It drives forwards, and its front is along y.
    EXPECT_NEAR(pose.velocity->linear_mps.y, 1.0, 1e-12);
    EXPECT_NEAR(pose.velocity->linear_mps.x, 0.0, 1e-12);
    EXPECT_DOUBLE_EQ(pose.velocity->angular_radps.z, 0.25);
}

TEST_F(Ros2Test, HearsPublishersThatGuaranteeNothingBesideReliableOnes) {
    const auto bus = listen_to_ros2({.topic = "/pose"}, kept_);
    FastDdsPublisher reliable(domain_, "/pose", "geometry_msgs/PoseStamped");
    ASSERT_TRUE(matched(reliable));
    reliable.write(pose_stamped_bytes(at(1, 1.0)));
    ASSERT_TRUE(kept_.wait_for(1));
    FastDdsPublisher careless(domain_, "/pose", "geometry_msgs/PoseStamped", {.reliable = false});
    ASSERT_TRUE(matched(careless));
    careless.write(pose_stamped_bytes(at(2, 2.0)));
    ASSERT_TRUE(kept_.wait_for(2));
    reliable.write(pose_stamped_bytes(at(3, 3.0)));
    ASSERT_TRUE(kept_.wait_for(3));
    EXPECT_EQ(kept_.messages().size(), 3U);
}

TEST_F(Ros2Test, HearsWhatWasSaidForGoodBeforeItCame) {
    FastDdsPublisher fixed(domain_, "/tf_static", "tf2_msgs/TFMessage", {.transient_local = true});
    fixed.write(transforms_bytes({at(1, 0.25, "base_footprint", "base_link")}));
    const auto bus = listen_to_ros2({.topic = "/tf", .fixed = "/tf_static"}, kept_);
    ASSERT_TRUE(kept_.wait_for(1));
    EXPECT_TRUE(kept_.messages().front().for_good);
    FastDdsPublisher moving(domain_, "/tf", "tf2_msgs/TFMessage");
    ASSERT_TRUE(matched(moving));
    moving.write(transforms_bytes({at(5, 1.0), at(5, 2.0, "base_link", "wheel")}, true));
    ASSERT_TRUE(kept_.wait_for(2));
    const Heard heard = kept_.messages().back();
    EXPECT_FALSE(heard.for_good);
    ASSERT_EQ(heard.poses.size(), 2U);
    EXPECT_EQ(heard.poses[1].child, "wheel");
    EXPECT_EQ(heard.poses[1].parent_from_child.translation_m.x, 2.0);
}

TEST_F(Ros2Test, HearsAPublisherThatWasStartedAgain) {
    const auto bus = listen_to_ros2({.topic = "/odom"}, kept_);
    for (int i = 1; i <= 2; ++i) {
        FastDdsPublisher publisher(domain_, "/odom", "nav_msgs/Odometry");
        ASSERT_TRUE(matched(publisher));
        publisher.write(odometry_bytes(at(i, i), std::vector<double>(6)));
        ASSERT_TRUE(kept_.wait_for(static_cast<std::size_t>(i)));
    }
}

TEST_F(Ros2Test, HearsAThousandMessagesASecond) {
    FastDdsPublisher publisher(domain_, "/odom", "nav_msgs/Odometry");
    const auto bus = listen_to_ros2({.topic = "/odom"}, kept_);
    ASSERT_TRUE(matched(publisher));
    for (int i = 1; i <= 1000; ++i) {
        publisher.write(odometry_bytes(at(i, i), std::vector<double>(6)));
        std::this_thread::sleep_for(1ms);
    }
    ASSERT_TRUE(kept_.wait_for(1000));
    const auto messages = kept_.messages();
    for (int i = 0; i < 1000; ++i)
        ASSERT_EQ(messages[i].poses[0].parent_from_child.translation_m.x, i + 1.0);
}

TEST_F(Ros2Test, RefusesDamagedMessagesAndGoesOn) {
    FastDdsPublisher publisher(domain_, "/odom", "nav_msgs/Odometry");
    const auto bus = listen_to_ros2({.topic = "/odom"}, kept_);
    ASSERT_TRUE(matched(publisher));
    const std::string good = odometry_bytes(at(1, 1.0), std::vector<double>(6));
    publisher.write(good.substr(0, 60));
    publisher.write(good);
    ASSERT_TRUE(kept_.wait_for(1, 1));
    EXPECT_THAT(kept_.refusals().front(), HasSubstr("nav_msgs/Odometry: "));
}

TEST_F(Ros2Test, TellsWhichTopicsThereAreInPlaceOfTheOneThatIsNot) {
    FastDdsPublisher publisher(domain_, "/odom", "nav_msgs/Odometry");
    FastDdsPublisher scans(domain_, "/scan", "sensor_msgs/LaserScan");
    const auto bus = listen_to_ros2({.topic = "/odm"}, kept_);
    ASSERT_TRUE(kept_.wait_for_trouble());
    EXPECT_THAT(kept_.trouble(), HasSubstr("no publisher of /odm; did you mean '/odom'?"));
    EXPECT_THAT(kept_.trouble(), HasSubstr("ROS domain " + std::to_string(domain_)));
    Kept of_scans;
    const auto another = listen_to_ros2({.topic = "/scan"}, of_scans);
    ASSERT_TRUE(of_scans.wait_for_trouble());
    EXPECT_THAT(of_scans.trouble(), HasSubstr("/scan is of sensor_msgs/LaserScan"));
}

TEST_F(Ros2Test, HearsNothingOfOtherDomains) {
    FastDdsPublisher elsewhere(domain_ == 199 ? 100 : domain_ + 1, "/odom", "nav_msgs/Odometry");
    const auto bus = listen_to_ros2({.topic = "/odom"}, kept_);
    ASSERT_TRUE(kept_.wait_for_trouble());
    EXPECT_THAT(kept_.trouble(), HasSubstr("no publisher of /odom; there are no topics"));
    EXPECT_EQ(elsewhere.subscribers(), 0);
}

}  // namespace
}  // namespace scipd::daemon
