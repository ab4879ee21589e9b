// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/clock/wall_clock.h"

#include <string>

#include <boost/asio/io_context.hpp>
#include <gtest/gtest.h>

#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

class WallClockTest : public testing::Test {
  protected:
    boost::asio::io_context io_;
    WallClock clock_{io_.get_executor()};
    std::string called_;
};

TEST_F(WallClockTest, CallsWhenItIsTimeAndNotEarlier) {
    const auto alarm = clock_.make_alarm();
    const sim::Time at = clock_.now() + 20ms;
    alarm->set(at, [&] {
        EXPECT_GE(clock_.now(), at);
        called_ += "x";
    });
    EXPECT_TRUE(run_until(io_, [&] { return called_ == "x"; }));
}

// The first one's time is over before it is replaced: its handler waits to be run.
TEST_F(WallClockTest, ForgetsWhatIsReplacedCancelledOrGone) {
    const auto alarm = clock_.make_alarm();
    alarm->set(clock_.now() - 1ms, [&] { called_ += "replaced"; });
    const auto cancelled = clock_.make_alarm();
    cancelled->set(clock_.now() - 1ms, [&] { called_ += "cancelled"; });
    auto gone = clock_.make_alarm();
    gone->set(clock_.now() - 1ms, [&] { called_ += "gone"; });
    io_.poll_one();  // of the three, whichever comes first
    called_.clear();
    alarm->set(clock_.now(), [&] { called_ += "new"; });
    cancelled->cancel();
    gone.reset();
    io_.restart();
    io_.run();
    EXPECT_EQ(called_, "new");
}

TEST_F(WallClockTest, LetsACallSetOrTakeAwayItsOwnAlarm) {
    auto alarm = clock_.make_alarm();
    alarm->set(clock_.now(), [&] {
        called_ += "a";
        alarm->set(clock_.now(), [&] {
            called_ += "b";
            alarm.reset();
        });
    });
    io_.run();
    EXPECT_EQ(called_, "ab");
}

}  // namespace
}  // namespace scipd::daemon
