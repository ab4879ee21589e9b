// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Messages of any bus as poses. That a bus really says them is tested with the bus.
#include <string>
#include <thread>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/bridges/bus.h"
#include "daemon/clock/stepped_clock.h"
#include "daemon/poses/heard_meaning.h"
#include "daemon/poses/pose_feed.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Says what it is told to, on a thread of its own.
class SaidBus : public Bus {
  public:
    SaidBus(BusListener& listener, const std::vector<Heard>& messages)
        : thread_([&listener, messages] {
              for (const Heard& message : messages)
                  listener.hear(message);
          }) {}
    ~SaidBus() override { thread_.join(); }

  private:
    std::thread thread_;
};

Heard transform_said(const std::string& parent, const std::string& child, sim::Time time,
                     double x_m) {
    HeardPose pose{.parent = parent, .child = child};
    if (time != sim::Time{}) pose.time = time;
    pose.parent_from_child.translation_m.x = x_m;
    return {.type = "tf2_msgs/TFMessage", .poses = {pose}};
}

Heard odometry_said(sim::Time time, double x_m) {
    Heard heard = transform_said("odom", "base_footprint", time, x_m);
    heard.type = "nav_msgs/Odometry";
    return heard;
}

Heard clock_said(sim::Time time) {
    return {.type = "rosgraph_msgs/Clock", .poses = {}, .clock = time};
}

PoseSource ros_source(const std::string& topic) {
    PoseSource source;
    source.kind = PoseSource::Kind::ros2;
    source.topic = topic;
    return source;
}

class BusFeedTest : public testing::Test {
  protected:
    BusFeedTest() { clock_.advance_to(10s); }

    std::shared_ptr<PoseFeed> feed(const std::vector<Heard>& messages, const RosFrames& frames = {},
                                   Lockstep* lockstep = nullptr) {
        const auto made = make_bus_feed(
            {.executor = io_.get_executor(),
             .intake = lockstep == nullptr ? intake_ : stepped_intake_,
             .clock = clock_,
             .lockstep = lockstep,
             .report = [this](const std::string& text) { reports_.push_back(text); }},
            ros_source("/tf"), make_ros_meaning(frames),
            [&](BusListener& listener) { return std::make_unique<SaidBus>(listener, messages); });
        made->serve("robot");
        return made;
    }

    [[nodiscard]] double robot_x(sim::Time time) const {
        return world_.robot("robot")->at(time).translation_m.x;
    }

    boost::asio::io_context io_;
    World world_ = wall_world();
    PoseIntake intake_{world_};
    Lockstep lockstep_{io_.get_executor()};
    PoseIntake stepped_intake_{world_, &lockstep_};
    SteppedClock clock_;
    std::vector<std::string> reports_;
};

TEST_F(BusFeedTest, TakesTheOnlyPoseOfEachMessage) {
    const auto poses = feed({odometry_said(100s, 1.0), odometry_said(100500ms, 2.0)});
    ASSERT_TRUE(run_until(io_, [&] { return intake_.accepted() == 2; }));
    EXPECT_DOUBLE_EQ(robot_x(10s), 1.0);
    EXPECT_DOUBLE_EQ(robot_x(10250ms), 1.5);
    const SourceReport report = poses->report();
    EXPECT_EQ(report.type, "nav_msgs/Odometry");
    EXPECT_EQ(report.messages, 2U);
    EXPECT_EQ(report.source, "ros2:/tf");
    EXPECT_TRUE(report.troubles.empty());
    poses->stop();
}

TEST_F(BusFeedTest, ComposesTheFramesBetweenTwo) {
    Heard fixed = transform_said("base_footprint", "base_link", {}, 0.5);
    fixed.for_good = true;
    const auto poses = feed({fixed, transform_said("odom", "base_footprint", 100s, 1.0),
                             transform_said("base_link", "wheel", 100100ms, 9.0),
                             transform_said("odom", "base_footprint", 100500ms, 2.0)});
    ASSERT_TRUE(run_until(io_, [&] { return poses->report().messages == 3; }));
    EXPECT_EQ(intake_.accepted(), 2U) << "a wheel that turns says nothing of the robot";
    EXPECT_EQ(intake_.refused(), 0U);
    EXPECT_DOUBLE_EQ(robot_x(10500ms), 2.5);
    poses->stop();
}

TEST_F(BusFeedTest, TellsWhichFrameIsNotThere) {
    const auto poses =
        feed({transform_said("odom", "base_link", 100s, 1.0)}, {.child = "base_lnk"});
    ASSERT_TRUE(run_until(io_, [&] { return poses->report().messages == 1; }));
    EXPECT_THAT(poses->report().troubles,
                ElementsAre("there is no frame 'base_lnk'; did you mean 'base_link'?"));
    ASSERT_TRUE(run_until(io_, [&] { return !reports_.empty(); }));
    EXPECT_THAT(reports_[0], HasSubstr("poses of robot from ros2:/tf: there is no frame"));
    poses->stop();
}

TEST_F(BusFeedTest, LetsStampsBeTheTimeInLockstep) {
    std::vector<Heard> messages;
    for (int i = 0; i <= 2000; ++i)
        messages.push_back(odometry_said(1000s + i * 1ms, i * 0.001));
    messages.insert(messages.begin() + 500, clock_said(3000s));  // stamps are there, and lead
    const auto poses = feed(messages, {}, &lockstep_);
    ASSERT_TRUE(run_until(io_, [&] { return lockstep_.clock().now() == 2s; }));
    EXPECT_EQ(stepped_intake_.accepted(), 2001U);
    EXPECT_DOUBLE_EQ(robot_x(1s), 1.0);
    EXPECT_EQ(lockstep_.clock().origin(), 1000s);
    poses->stop();
}

TEST_F(BusFeedTest, LetsTheClockLeadWherePosesSayNoTime) {
    const auto poses = feed({clock_said(50s), odometry_said({}, 1.0), clock_said(50100ms),
                             odometry_said({}, 2.0), clock_said(50200ms)},
                            {}, &lockstep_);
    ASSERT_TRUE(run_until(io_, [&] { return lockstep_.clock().now() == 200ms; }));
    EXPECT_DOUBLE_EQ(robot_x(0s), 1.0);
    EXPECT_DOUBLE_EQ(robot_x(100ms), 2.0);
    poses->stop();
}

TEST_F(BusFeedTest, FollowsASimulationThatIsResetInLockstep) {
    std::vector<Heard> messages{odometry_said(500s, 1.0), odometry_said(501s, 2.0)};
    for (int i = 0; i <= 20; ++i)
        messages.push_back(odometry_said(1s + i * 100ms, 7.0));
    const auto poses = feed(messages, {}, &lockstep_);
    ASSERT_TRUE(run_until(io_, [&] { return lockstep_.clock().now() == 3s; }));
    EXPECT_DOUBLE_EQ(robot_x(3s), 7.0);
    poses->stop();
}

TEST_F(BusFeedTest, EndsWhileTheBusWaitsInLockstep) {
    const std::vector<Heard> many(5000, odometry_said(1s, 1.0));
    const auto poses = feed(many, {}, &lockstep_);
    poses->stop();
}

}  // namespace
}  // namespace scipd::daemon
