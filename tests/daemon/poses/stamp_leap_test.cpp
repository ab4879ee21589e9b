// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Stamps that leap in lockstep, as the intake of poses takes them.
#include "daemon/poses/stamp_leap.h"

#include <optional>
#include <string>

#include <boost/asio/io_context.hpp>
#include <gmock/gmock.h>

#include "daemon/poses/pose_intake.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using testing::Optional;
using testing::StartsWith;

class PoseIntakeInLockstep : public testing::Test {
  protected:
    std::optional<std::string> take(const std::string& line) {
        return intake_.take_line(line, {}, sender_, 0s);
    }
    std::optional<std::string> take_stamped(double t_s, const std::string& rest = "") {
        return take("{\"t\":" + std::to_string(t_s) + ",\"xyz\":[1,0,0]" + rest + "}");
    }
    /// Poses 20 ms apart; how many were refused before one was taken again.
    int refused_from(double first_s, int poses = 200) {
        int refused = 0;
        for (int i = 0; i < poses; ++i) {
            const bool taken = !take_stamped(first_s + i * 0.02);
            EXPECT_TRUE(taken || refused == i) << first_s << " " << i;
            if (!taken) ++refused;
        }
        return refused;
    }
    /// What time it is once everything is done that the poses lead to; never less than before.
    sim::Time now() {
        io_.restart();
        io_.run();
        const sim::Time now = lockstep_.clock().now();
        EXPECT_GE(now, now_before_);
        return now_before_ = now;
    }
    sim::Time stamp_now() { return now() + lockstep_.clock().origin(); }

    boost::asio::io_context io_;
    Lockstep lockstep_{io_.get_executor()};
    World world_ = wall_world();
    PoseIntake intake_{world_, &lockstep_};
    SenderClock sender_;
    sim::Time now_before_{};
};

TEST_F(PoseIntakeInLockstep, LetsNoRefusedPoseSayWhereTimeBegins) {
    EXPECT_TRUE(take(R"({"robot":"nobody","t":5,"xyz":[0,0,0]})"));
    EXPECT_EQ(take(R"({"t":-8999999999,"xyz":[1,0,0]})"), std::nullopt);
    EXPECT_EQ(lockstep_.clock().origin(), -8'999'999'999s);
    EXPECT_EQ(world_.robot("robot")->at(0s).translation_m.x, 1.0);
    EXPECT_EQ(intake_.refused(), 1U);
}

TEST_F(PoseIntakeInLockstep, RefusesOneStampThatLeapsAndGoesOn) {
    EXPECT_EQ(refused_from(10.0), 0);
    for (const double leap_s : {1e6, -1e6, 8.9e9, -8.9e9, 700.0, 0.0}) {
        EXPECT_THAT(take_stamped(leap_s), Optional(StartsWith("t: leaps from 13.980 s to ")));
        EXPECT_EQ(take_stamped(13.98), World::not_later);
    }
    EXPECT_EQ(intake_.last_refusal(), World::not_later);
    EXPECT_EQ(refused_from(14.0), 0);
    EXPECT_EQ(stamp_now(), 17'960ms);  // something else may be said of 17.98
    EXPECT_EQ(now(), 7960ms);
}

// Every second packet is damaged: the others are the time.
TEST_F(PoseIntakeInLockstep, GoesOnBesideStampsThatLeapAgainAndAgain) {
    for (int i = 0; i < 500; ++i) {
        ASSERT_FALSE(take_stamped(i * 0.02));
        ASSERT_TRUE(take_stamped(5000.0 + i * 0.02));
    }
    EXPECT_EQ(stamp_now(), 9960ms);
}

TEST_F(PoseIntakeInLockstep, TakesUpASimulatorThatIsStartedAgain) {
    EXPECT_EQ(refused_from(1000.0), 0);
    for (int run = 1; run <= 3; ++run) {
        // A second of stamps and one more.
        EXPECT_EQ(refused_from(0.0), 51) << run;
        EXPECT_EQ(stamp_now(), 3960ms);
        EXPECT_EQ(now(), 3960ms + run * 3980ms);
        EXPECT_EQ(world_.robot("robot")->last_time(), 3980ms + run * 3980ms);
    }
}

TEST_F(PoseIntakeInLockstep, LeapsToWhereItsStampsGoOn) {
    EXPECT_EQ(refused_from(0.0), 0);
    EXPECT_EQ(refused_from(1.7e9), 51);
    // JSON has so large numbers to some hundreds of nanoseconds.
    EXPECT_LT(std::chrono::abs(stamp_now() - 1'700'000'003'960ms), 2us);
    EXPECT_EQ(refused_from(-8.9e9), 51);
    EXPECT_LT(std::chrono::abs(now() - (3960ms + 2 * 3980ms)), 2us);
}

TEST_F(PoseIntakeInLockstep, GetsOverAFirstStampThatIsDamaged) {
    EXPECT_EQ(take_stamped(1e6), std::nullopt);
    EXPECT_EQ(refused_from(0.0), 51);
    EXPECT_EQ(stamp_now(), 3960ms);
}

// It connects anew, say.
TEST_F(PoseIntakeInLockstep, TakesUpAnotherSender) {
    EXPECT_EQ(refused_from(1000.0), 0);
    sender_ = {};
    EXPECT_EQ(refused_from(0.0), 51);
}

// Their poses lie far apart, and so does the second that they agree for.
TEST_F(PoseIntakeInLockstep, TakesUpASenderOfFewPoses) {
    EXPECT_EQ(take_stamped(1000.0), std::nullopt);
    EXPECT_EQ(take_stamped(1500.0), std::nullopt);
    EXPECT_TRUE(take_stamped(0.0));
    EXPECT_EQ(take_stamped(100.0), std::nullopt);
    EXPECT_EQ(take_stamped(200.0), std::nullopt);
    EXPECT_EQ(stamp_now(), 100s);
    EXPECT_EQ(now(), 600s);
}

// A model that has not moved before takes any time.
TEST_F(PoseIntakeInLockstep, TakesUpARunInWhichSomethingElseMoves) {
    EXPECT_EQ(refused_from(1000.0), 0);
    int refused = 0;
    for (int i = 0; i < 200; ++i) {
        take_stamped(i * 0.02, R"(,"model":"model 1")");
        if (take_stamped(i * 0.02)) ++refused;
    }
    EXPECT_EQ(refused, 51);
    EXPECT_EQ(stamp_now(), 3960ms);
}

TEST_F(PoseIntakeInLockstep, MovesNothingEvenlyAcrossALeap) {
    EXPECT_EQ(take(R"({"t":1000,"xyz":[1,0,0]})"), std::nullopt);
    for (int i = 0; i < 200; ++i)
        take("{\"t\":" + std::to_string(i * 0.02) + ",\"xyz\":[2,0,0]}");
    const sim::PoseTrack& robot = *world_.robot("robot");
    for (sim::Time time = 0s; time < robot.last_time(); time += 1ms)
        ASSERT_DOUBLE_EQ(robot.at(time).translation_m.x, time < 1020ms ? 1.0 : 2.0) << time / 1ms;
}

TEST_F(PoseIntakeInLockstep, LeavesTheTimeToThoseWhoLeadIt) {
    lockstep_.add(&sender_);
    EXPECT_EQ(refused_from(1000.0), 0);
    SenderClock other;
    for (int i = 0; i < 200; ++i) {
        const std::string line =
            "{\"model\":\"model 1\",\"t\":" + std::to_string(5000.0 + i * 0.02) +
            ",\"xyz\":[0,0,0]}";
        ASSERT_EQ(intake_.take_line(line, {}, other, 0s).value_or("").substr(0, 8), "t: leaps");
    }
    EXPECT_EQ(stamp_now(), 1'003'960ms);
    EXPECT_EQ(refused_from(1004.0), 0);
}

// Each of two streams, such as those of two robots, says where it goes on.
TEST_F(PoseIntakeInLockstep, TakesUpStreamsThatShareTheirTime) {
    world_.set_robots({{"robot", {}}, {"second", {}}});
    SenderClock second;
    lockstep_.add(&sender_);
    lockstep_.add(&second);
    const auto run = [&](double first_s, int behind) {
        int refused = 0;
        for (int i = 0; i < 200 + behind; ++i) {
            const auto line = [&](int k) {
                return "{\"t\":" + std::to_string(first_s + k * 0.02) + ",\"xyz\":[1,0,0]}";
            };
            if (i < 200 && intake_.take_line(line(i), "robot", sender_, 0s)) ++refused;
            if (i >= behind && intake_.take_line(line(i - behind), "second", second, 0s)) ++refused;
        }
        return refused;
    };
    EXPECT_EQ(run(1000.0, 3), 0);
    EXPECT_EQ(stamp_now(), 1'003'960ms);
    EXPECT_LE(run(0.0, 3), 2 * 52);
    EXPECT_EQ(stamp_now(), 3960ms);
}

}  // namespace
}  // namespace scipd::daemon
