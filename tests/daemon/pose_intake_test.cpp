// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/control/pose_intake.h"

#include <boost/asio/io_context.hpp>
#include <gtest/gtest.h>

#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

TEST(SenderClock, TakesTheTimeOfArrivalWhereThereIsNoStamp) {
    SenderClock sender;
    EXPECT_EQ(sender.world_time(std::nullopt, 3s), 3s);
    EXPECT_EQ(sender.world_time(std::nullopt, 5s), 5s);
}

TEST(SenderClock, KeepsTheSpacingOfStampsWhateverTheyBeginWith) {
    SenderClock sender;
    EXPECT_EQ(sender.world_time(1'700'000'000s, 3s), 3s);
    // Arrivals jitter.
    EXPECT_EQ(sender.world_time(1'700'000'000s + 100ms, 3s + 170ms), 3100ms);
    EXPECT_EQ(sender.world_time(1'700'000'000s + 200ms, 3s + 201ms), 3200ms);
    // A late packet keeps its place.
    EXPECT_EQ(sender.world_time(1'700'000'000s + 150ms, 3s + 300ms), 3150ms);
}

TEST(SenderClock, TakesUpAnewASenderThatStartsOver) {
    SenderClock sender;
    EXPECT_EQ(sender.world_time(100s, 3s), 3s);
    EXPECT_EQ(sender.world_time(0s, 10s), 10s);
    EXPECT_EQ(sender.world_time(1s, 12s), 11s);
}

TEST(SenderClock, TakesUpAnewASenderWhoseClockLeaps) {
    SenderClock sender;
    EXPECT_EQ(sender.world_time(10s, 3s), 3s);
    // A clock that is set, and one damaged stamp.
    EXPECT_EQ(sender.world_time(1'700'000'000s, 3100ms), 3100ms);
    EXPECT_EQ(sender.world_time(1'700'000'000s + 100ms, 3205ms), 3200ms);
    EXPECT_EQ(sender.world_time(9'000'000'000s, 3300ms), 3300ms);
    EXPECT_EQ(sender.world_time(-9'000'000'000s, 3400ms), 3400ms);
    EXPECT_EQ(sender.world_time(9'000'000'000s, 3500ms), 3500ms);
    EXPECT_EQ(sender.world_time(1'700'000'000s + 500ms, 3600ms), 3600ms);
}

TEST(SenderClock, LetsASenderPauseAndSendAhead) {
    SenderClock sender;
    EXPECT_EQ(sender.world_time(0s, 3s), 3s);
    EXPECT_EQ(sender.world_time(3600s, 3603s), 3603s);
    // A whole drive at once.
    EXPECT_EQ(sender.world_time(3601s, 3603s), 3604s);
    EXPECT_EQ(sender.world_time(3602s, 3603s), 3605s);
    EXPECT_EQ(sender.world_time(3603s, 3603s), 3606s);
}

class PoseIntakeTest : public testing::Test {
  protected:
    std::optional<std::string> take(const char* line, sim::Time arrival,
                                    const char* robot = "robot") {
        return intake_.take_line(line, robot, sender_, arrival);
    }
    [[nodiscard]] double robot_x() const { return world_.robot("robot")->last().translation_m.x; }

    World world_ = wall_world();
    PoseIntake intake_{world_};
    SenderClock sender_;
};

TEST_F(PoseIntakeTest, CountsWhatItTakesAndWhatItRefuses) {
    EXPECT_FALSE(take(R"({"xyz":[1,0,0]})", 1s));
    EXPECT_TRUE(take("rubbish", 2s));
    EXPECT_TRUE(take(R"({"xyz":[1,0]})", 2s));
    EXPECT_FALSE(take("0 2 0 0 0 0 0 1", 3s));
    EXPECT_EQ(take(R"({"t":0,"xyz":[9,0,0]})", 3s), "t: not later than the pose before it");
    EXPECT_EQ(intake_.accepted(), 2U);
    EXPECT_EQ(intake_.refused(), 3U);
    EXPECT_EQ(intake_.last_refusal(), "t: not later than the pose before it");
    EXPECT_DOUBLE_EQ(robot_x(), 2.0);
}

TEST_F(PoseIntakeTest, TakesALineWithoutATimeInThePlaceOfWhatWasSaidForLater) {
    EXPECT_FALSE(take(R"({"t":0,"xyz":[1,0,0]})", 1s));
    EXPECT_FALSE(take(R"({"t":0.8,"xyz":[2,0,0]})", 1s));
    EXPECT_FALSE(take(R"({"xyz":[9,0,0]})", 1500ms));
    EXPECT_DOUBLE_EQ(robot_x(), 9.0);
    EXPECT_DOUBLE_EQ(world_.robot("robot")->at(10s).translation_m.x, 9.0);
}

TEST_F(PoseIntakeTest, HandsVelocitiesOn) {
    world_.set_robots({{"robot", {.policy = {.after = sim::PosePolicy::After::extrapolate}}}});
    EXPECT_FALSE(take(R"({"xyz":[1,0,0],"v":[2,0,0]})", 1s));
    EXPECT_DOUBLE_EQ(world_.robot("robot")->at(1250ms).translation_m.x, 1.5);
}

TEST_F(PoseIntakeTest, KnowsWhomALineMeans) {
    world_.set_robots({{"robot", {}}, {"second", {}}});
    EXPECT_FALSE(take(R"({"robot":"second","xyz":[5,0,0]})", 1s));
    EXPECT_DOUBLE_EQ(robot_x(), 0.0);
    EXPECT_DOUBLE_EQ(world_.robot("second")->last().translation_m.x, 5.0);
    EXPECT_FALSE(take(R"({"model":"model 1","xyz":[6,0,0]})", 1s));
    EXPECT_DOUBLE_EQ(robot_x(), 0.0);
    EXPECT_FALSE(take(R"({"xyz":[7,0,0]})", 1s));
    EXPECT_DOUBLE_EQ(robot_x(), 7.0);
    EXPECT_EQ(take(R"({"xyz":[8,0,0]})", 2s, ""), "robot: say which; robots are robot, second");
}

TEST(PoseIntakeInLockstep, LetsNoRefusedPoseSayWhereTimeBegins) {
    boost::asio::io_context io;
    Lockstep lockstep(io.get_executor());
    World world = wall_world();
    PoseIntake intake(world, &lockstep);
    SenderClock sender;
    const auto take = [&](const char* line) { return intake.take_line(line, {}, sender, 0s); };
    EXPECT_TRUE(take(R"({"robot":"nobody","t":5,"xyz":[0,0,0]})"));
    EXPECT_EQ(take(R"({"t":-8999999999,"xyz":[1,0,0]})"), std::nullopt);
    EXPECT_EQ(lockstep.clock().origin(), -8'999'999'999s);
    EXPECT_EQ(world.robot("robot")->at(0s).translation_m.x, 1.0);
    EXPECT_EQ(take(R"({"t":9,"xyz":[2,0,0]})"), "t: too far from the first one");
    EXPECT_EQ(intake.refused(), 2U);
}

}  // namespace
}  // namespace scipd::daemon
