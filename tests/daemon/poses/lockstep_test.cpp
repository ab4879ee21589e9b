// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/poses/lockstep.h"

#include <string>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

class LockstepTest : public testing::Test {
  protected:
    void settle() {
        io_.restart();
        io_.run();
    }

    sim::Time now_after(auto say) {
        say();
        settle();
        return lockstep_.clock().now();
    }

    boost::asio::io_context io_;
    Lockstep lockstep_{io_.get_executor()};
    int first_ = 0;  // their addresses are the streams
    int second_ = 0;
};

TEST_F(LockstepTest, CountsFromTheFirstStamp) {
    EXPECT_EQ(lockstep_.world_time(1'760'000'000s), 0s);
    lockstep_.begin_with(1'760'000'000s);
    EXPECT_EQ(lockstep_.world_time(1'760'000'001s), 1s);
    lockstep_.begin_with(1'760'000'001s);
    lockstep_.come_to(&first_, 1s, true);
    settle();
    EXPECT_EQ(lockstep_.clock().now(), 1s);
    EXPECT_EQ(lockstep_.clock().origin(), 1'760'000'000s);
}

TEST_F(LockstepTest, CountsFromNoStampThatWasOnlyAskedAbout) {
    EXPECT_EQ(lockstep_.world_time(5s), 0s);
    EXPECT_EQ(lockstep_.world_time(7s), 0s);
    lockstep_.begin_with(7s);
    EXPECT_EQ(lockstep_.world_time(5s), -2s);
}

TEST_F(LockstepTest, KeepsTheTimeThatATrajectoryHasLed) {
    lockstep_.come_to(&first_, 3s, true);
    settle();
    EXPECT_EQ(lockstep_.world_time(4s), 4s);
    lockstep_.begin_with(4s);
    EXPECT_EQ(lockstep_.clock().origin(), 0s);
}

TEST_F(LockstepTest, HasNoTimeForStampsThatLieTooFarApart) {
    lockstep_.begin_with(-4'500'000'000s);
    EXPECT_EQ(lockstep_.world_time(0s), 4'500'000'000s);
    EXPECT_EQ(lockstep_.world_time(1s), std::nullopt);
    EXPECT_EQ(lockstep_.world_time(9'000'000'000s), std::nullopt);
    EXPECT_EQ(lockstep_.world_time(-9'000'000'000s), -4'500'000'000s);
}

TEST_F(LockstepTest, GoesOnAsFarAsTheSlowestStream) {
    lockstep_.add(&first_);
    lockstep_.add(&second_);
    EXPECT_EQ(now_after([&] { lockstep_.come_to(&first_, 5s, true); }), 0s);
    EXPECT_EQ(now_after([&] { lockstep_.come_to(&second_, 3s, true); }), 3s);
    EXPECT_EQ(now_after([&] { lockstep_.come_to(&second_, 9s, true); }), 5s);
    EXPECT_EQ(now_after([&] { lockstep_.remove(&first_); }), 9s);
}

TEST_F(LockstepTest, WaitsUntilAStampIsPastWhereMoreMayBeSaidOfIt) {
    lockstep_.add(&first_);
    EXPECT_EQ(now_after([&] { lockstep_.come_to(&first_, 1s, false); }), 0s);
    EXPECT_EQ(now_after([&] { lockstep_.come_to(&first_, 1s, false); }), 0s);
    EXPECT_EQ(now_after([&] { lockstep_.come_to(&first_, 2s, false); }), 1s);
    EXPECT_EQ(now_after([&] { lockstep_.remove(&first_); }), 2s);  // it has said all
}

TEST_F(LockstepTest, LetsAnyoneLeadWhereThereIsNoStream) {
    EXPECT_EQ(now_after([&] { lockstep_.come_to(&first_, 2s, true); }), 2s);
    lockstep_.add(&second_);
    EXPECT_EQ(now_after([&] { lockstep_.come_to(&first_, 9s, true); }), 2s);
    EXPECT_EQ(now_after([&] { lockstep_.come_to(&second_, 4s, true); }), 4s);
}

TEST_F(LockstepTest, DoesWhatIsDueOnTheWayInOrder) {
    std::vector<sim::Time> calls;
    const auto alarm = lockstep_.clock().make_alarm();
    std::function<void()> again = [&] {
        calls.push_back(lockstep_.clock().now());
        alarm->set(lockstep_.clock().now() + 25ms, again);
    };
    alarm->set(25ms, again);
    lockstep_.come_to(&first_, 10s, true);
    settle();
    ASSERT_EQ(calls.size(), 400U);
    EXPECT_EQ(calls.back(), 10s);
}

TEST_F(LockstepTest, StandsStillWhileSomebodyHoldsIt) {
    SteppedClock& clock = lockstep_.clock();
    const auto alarm = clock.make_alarm();
    alarm->set(1s, [&] { clock.hold(&first_, true); });
    EXPECT_EQ(now_after([&] { lockstep_.come_to(&second_, 10s, true); }), 1s);
    EXPECT_EQ(now_after([&] { lockstep_.come_to(&second_, 20s, true); }), 1s);
    EXPECT_EQ(now_after([&] { clock.hold(&first_, false); }), 20s);
}

TEST_F(LockstepTest, TellsWhenThereIsRoomForMore) {
    std::string told;
    lockstep_.when_caught_up([&] { told += "a"; });
    lockstep_.come_to(&first_, 1s, true);
    EXPECT_EQ(told, "");
    settle();
    EXPECT_EQ(told, "a");

    // As long as nobody waits for anything a trajectory need not go on.
    lockstep_.when_awaited([&] { told += "b"; });
    settle();
    EXPECT_EQ(told, "a");
    const auto alarm = lockstep_.clock().make_alarm();
    alarm->set(5s, [&] {});
    settle();
    EXPECT_EQ(told, "ab");
}

}  // namespace
}  // namespace scipd::daemon
