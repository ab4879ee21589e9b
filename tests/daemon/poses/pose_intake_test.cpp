// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/poses/pose_intake.h"

#include <algorithm>
#include <optional>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/wall_world.h"
#include "tests/support/why_not.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using tests::why_not;

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

/// Sends at 50 Hz of its own time, by a clock that runs `speed` times as fast as ours, over a
/// network that keeps the order.
class Sender {
  public:
    explicit Sender(double speed) : speed_(speed) {}

    /// The next stamp arrives `delay` after it was sent.
    void send(sim::Time delay = 0s) {
        const sim::Time before = world_;
        const sim::Time stamp = step * sent_++;
        const auto sent_at = std::chrono::duration_cast<sim::Time>(stamp / speed_);
        arrival_ = std::max(arrival_, 10s + sent_at + delay);
        world_ = clock_.world_time(first_stamp + stamp, arrival_);
        if (sent_ == 1) return;
        slowest_ = std::min(slowest_, world_ - before);
        latest_ = std::max(latest_, arrival_ - world_);
        earliest_ = std::max(earliest_, world_ - arrival_);
    }
    void send_for(sim::Time duration) {
        for (auto left = static_cast<int>(std::chrono::duration<double>(duration) / step * speed_);
             left > 0; --left)
            send();
    }

    /// World time where nothing was moved.
    [[nodiscard]] sim::Time unmoved() const { return 10s + step * (sent_ - 1); }
    [[nodiscard]] sim::Time world() const { return world_; }
    [[nodiscard]] sim::Time arrival() const { return arrival_; }
    [[nodiscard]] sim::Time slowest() const { return slowest_; }
    [[nodiscard]] sim::Time latest() const { return latest_; }
    [[nodiscard]] sim::Time earliest() const { return earliest_; }

    static constexpr sim::Time step = 20ms;
    static constexpr sim::Time first_stamp = 1'700'000'000s;

  private:
    double speed_;
    int sent_ = 0;
    SenderClock clock_;
    sim::Time world_{};
    sim::Time arrival_{};
    sim::Time slowest_ = sim::Time::max();
    sim::Time latest_{};
    sim::Time earliest_{};
};

TEST(SenderClock, LeavesASenderThatKeepsTimeExactlyWhereItsStampsSay) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> jitter_us(-50'000, 50'000);
    Sender sender(1.0);
    sender.send();
    for (int i = 0; i < 3000; ++i) {
        sender.send(std::chrono::microseconds(jitter_us(random)));
        ASSERT_EQ(sender.world(), sender.unmoved()) << i;
    }
}

class SenderAtAnotherSpeed : public testing::TestWithParam<double> {};

TEST_P(SenderAtAnotherSpeed, IsFollowed) {
    Sender sender(GetParam());
    sender.send_for(60s);
    EXPECT_NE(sender.world(), sender.unmoved());
    const sim::Time apart = std::chrono::abs(sender.world() - sender.arrival());
    EXPECT_LE(apart, 100ms + 3 * Sender::step);
    // It would be 12 s by now; half a second of patience is a tenth of one.
    EXPECT_LE(std::max(sender.latest(), sender.earliest()), 100ms + 100ms + 3 * Sender::step);
    EXPECT_GE(sender.slowest(), Sender::step / 10);
}

// Twenty times the speed is more than can be followed; time never stands still for it.
TEST(SenderClock, GrowsByATenthOfTheStepsAtLeast) {
    Sender sender(20.0);
    sender.send_for(10s);
    EXPECT_EQ(sender.slowest(), Sender::step / 10);
}

INSTANTIATE_TEST_SUITE_P(SlowAndFast, SenderAtAnotherSpeed, testing::Values(0.8, 1.2));

TEST(SenderClock, FollowsThroughJitter) {
    for (const double speed : {0.8, 1.2}) {
        std::mt19937 random(1);
        std::uniform_int_distribution<int> jitter_us(-50'000, 50'000);
        Sender sender(speed);
        for (int i = 0; i < 3000; ++i)
            sender.send(std::chrono::microseconds(jitter_us(random)));
        // The border, the patience, the jitter from one end to the other and a second patience.
        EXPECT_LE(std::max(sender.latest(), sender.earliest()), 400ms) << speed;
        EXPECT_GE(sender.slowest(), Sender::step / 10) << speed;
    }
}

TEST(SenderClock, IsNotMovedByWhatIsLateOnce) {
    Sender sender(1.0);
    sender.send_for(1s);
    for (const sim::Time delay : {300ms, 5000ms}) {
        sender.send(delay);
        EXPECT_EQ(sender.world(), sender.unmoved());
        EXPECT_EQ(sender.arrival() - sender.world(), delay);
        // Those behind it have been held up as well.
        for (int i = 0; i < 500; ++i) {
            sender.send();
            ASSERT_EQ(sender.world(), sender.unmoved()) << i;
        }
    }
}

TEST(SenderClock, IsNotMovedByWhatIsLateForLessThanHalfASecond) {
    Sender sender(1.0);
    sender.send_for(1s);
    for (int i = 0; i < 250; ++i) {
        sender.send(i % 50 < 20 ? 300ms : 0ms);
        ASSERT_EQ(sender.world(), sender.unmoved()) << i;
    }
}

TEST(SenderClock, IsNotMovedByAPacketThatWasOvertaken) {
    SenderClock sender;
    for (int i = 0; i < 200; ++i) {
        ASSERT_EQ(sender.world_time(i * 20ms, 10s + i * 20ms), 10s + i * 20ms);
        if (i < 15) continue;
        ASSERT_EQ(sender.world_time(i * 20ms - 290ms, 10s + i * 20ms), 9710ms + i * 20ms);
    }
}

TEST(SenderClock, IsNotThrownByAPacketHeldUpWhileItFollows) {
    Sender with(0.8);
    Sender without(0.8);
    for (int i = 0; i < 1000; ++i) {
        with.send(i == 500 ? 300ms : 0ms);
        without.send();
        ASSERT_LE(with.world() - without.world(), Sender::step) << i;
    }
    EXPECT_LE(without.world() - with.world(), Sender::step);
}

// A simulator that stood still.
TEST(SenderClock, FollowsASenderThatComesLateFromNowOn) {
    Sender sender(1.0);
    sender.send_for(1s);
    for (int i = 0; i < 50; ++i)
        sender.send(10s);
    EXPECT_EQ(sender.arrival() - sender.world(), 100ms);
    EXPECT_EQ(sender.slowest(), Sender::step);
}

TEST(SenderClock, GoesByTheLeastLateAndTheLeastEarly) {
    Sender late(1.0);
    late.send_for(1s);
    for (int i = 0; i <= 100; ++i)
        late.send(i % 2 == 0 ? 10s : 10s + 15ms);
    EXPECT_EQ(late.arrival() - late.world(), 100ms);

    // Where the first one of all was late, the others come early.
    Sender early(1.0);
    early.send(1s);
    for (int i = 0; i <= 200; ++i)
        early.send(i % 2 == 0 ? 15ms : 0ms);
    EXPECT_EQ(early.world() - early.arrival(), 100ms);
}

TEST(SenderClock, MapsEqualStampsToOneMomentWhileItFollows) {
    SenderClock sender;
    for (int i = 0; i < 200; ++i) {
        const sim::Time first = sender.world_time(i * 20ms, i * 25ms);
        ASSERT_EQ(sender.world_time(i * 20ms, i * 25ms + 1ms), first) << i;
    }
    EXPECT_GT(sender.world_time(4s, 5s), 4s);
}

class PoseIntakeTest : public testing::Test {
  protected:
    std::optional<std::string> take(const char* line, sim::Time arrival,
                                    const char* robot = "robot") {
        return why_not(intake_.take_line(line, robot, sender_, arrival));
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

TEST(PoseIntake, RefusesWhatASenderSendsTooMuchOf) {
    World world = wall_world();
    LimitValues values;
    values[Limit::poses_per_s] = 2;
    const auto limits = std::make_shared<Limits>(values);
    PoseIntake intake(world, nullptr, limits);
    Rate eager;
    Rate other;
    EXPECT_TRUE(intake.admit(eager));
    EXPECT_TRUE(intake.admit(eager));
    EXPECT_FALSE(intake.admit(eager));
    EXPECT_TRUE(intake.admit(other));
    EXPECT_EQ(intake.refused(), 1U);
    EXPECT_EQ(intake.last_refusal(),
              "more than 2 poses a second of one sender; poses_per_s under "
              "limits in the configuration allows more");
    EXPECT_EQ(limits->refused(Limit::poses_per_s), 1U);
}

TEST(PoseIntake, CountsNoSecondsWhereTimeWaitsForPoses) {
    boost::asio::io_context io;
    World world = wall_world();
    Lockstep lockstep(io.get_executor());
    LimitValues values;
    values[Limit::poses_per_s] = 1;
    PoseIntake intake(world, &lockstep, std::make_shared<Limits>(values));
    Rate sender;
    for (int i = 0; i < 10; ++i)
        EXPECT_TRUE(intake.admit(sender));
}

// Anybody who may write at a broker can say what is to be the time.
TEST(PoseIntake, TakesNoStepThatLeapsBeforeOthersFollowIt) {
    boost::asio::io_context io;
    World world = wall_world();
    Lockstep lockstep(io.get_executor());
    PoseIntake intake(world, &lockstep);
    SenderClock leader;
    lockstep.add(&leader);
    const auto step = [&](sim::Time stamp) -> std::optional<sim::Time> {
        const auto time = intake.take_step(stamp, leader);
        if (!time) return std::nullopt;
        lockstep.come_to(&leader, *time, true);
        io.restart();
        io.poll();
        return *time;
    };
    constexpr sim::Time begin = 1'700'000'000s;
    EXPECT_EQ(step(begin), 0s);
    EXPECT_EQ(step(begin + 20ms), 20ms);
    for (const sim::Time forged : {sim::Time(1'000'000'000'000'000'000),
                                   sim::Time(9'000'000'000'000'000'000), begin + 11min}) {
        EXPECT_EQ(step(forged), std::nullopt);
        EXPECT_EQ(lockstep.clock().now(), 20ms);
    }
    EXPECT_THAT(*intake.last_refusal(), testing::HasSubstr("leaps from 1700000000.020 s"));
    EXPECT_EQ(step(begin + 40ms), 40ms);
    // Whoever leads was started again.
    EXPECT_EQ(step(5s), std::nullopt);
    EXPECT_EQ(step(5500ms), std::nullopt);
    EXPECT_EQ(step(6100ms), 1140ms);
    EXPECT_EQ(step(6200ms), 1240ms);
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
    EXPECT_EQ(take(R"({"xyz":[8,0,0]})", 2s, ""), "robot is missing; robots are robot, second");
}

// A packet of 50 Hz comes every 20 ms, whatever its stamp says.
class StampsOnTheWallClock : public PoseIntakeTest {
  protected:
    /// Whether poses from this stamp on are taken once half a second has passed.
    void expect_taken_from(double first_s, int packets = 100) {
        for (int i = 0; i < packets; ++i) {
            const auto refusal = take_stamped(first_s + i * 0.02, i);
            if (i < 25) continue;
            ASSERT_EQ(refusal, std::nullopt) << i;
            ASSERT_DOUBLE_EQ(robot_x(), i);
        }
    }
    std::optional<std::string> take_stamped(double t_s, int x) {
        arrival_ += 20ms;
        const std::string line =
            "{\"t\":" + std::to_string(t_s) + ",\"xyz\":[" + std::to_string(x) + ",0,0]}";
        return take(line.c_str(), arrival_);
    }

    sim::Time arrival_ = 3s;
};

TEST_F(StampsOnTheWallClock, MayBeginAgain) {
    expect_taken_from(1000.0);
    expect_taken_from(0.0);
    expect_taken_from(1e6);
    expect_taken_from(0.0);
}

TEST_F(StampsOnTheWallClock, MayLeapOnce) {
    expect_taken_from(10.0);
    take_stamped(1e6, 0);
    expect_taken_from(12.02);
    take_stamped(-1e6, 0);
    expect_taken_from(14.04);
}

}  // namespace
}  // namespace scipd::daemon
