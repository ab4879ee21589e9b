// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/clock/stepped_clock.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

TEST(SteppedClock, CallsInTheOrderOfTimeAndEachAtItsOwn) {
    SteppedClock clock;
    std::string called;
    const auto at = [&](char name, sim::Time time) {
        return [&, name, time] {
            EXPECT_EQ(clock.now(), time);
            called += name;
        };
    };
    const auto late = clock.make_alarm();
    const auto early = clock.make_alarm();
    const auto second_of_the_same_time = clock.make_alarm();
    late->set(30ms, at('c', 30ms));
    early->set(10ms, at('a', 10ms));
    second_of_the_same_time->set(10ms, at('b', 10ms));
    clock.advance_to(20ms);
    EXPECT_EQ(called, "ab");
    EXPECT_EQ(clock.now(), 20ms);
    clock.advance_to(30ms);
    EXPECT_EQ(called, "abc");
}

TEST(SteppedClock, CallsWhatIsSetOnTheWay) {
    SteppedClock clock;
    const auto alarm = clock.make_alarm();
    int calls = 0;
    std::function<void()> again = [&] {
        ++calls;
        alarm->set(clock.now() + 10ms, again);
    };
    alarm->set(10ms, again);
    clock.advance_to(1s);
    EXPECT_EQ(calls, 100);
}

TEST(SteppedClock, SaysThatItSteps) {
    SteppedClock clock;
    std::string order;
    clock.on_step([&] { order += '.'; });
    const auto alarm = clock.make_alarm();
    alarm->set(10ms, [&] { order += 'a'; });
    clock.advance_to(20ms);
    EXPECT_EQ(order, ".a.");
}

TEST(SteppedClock, CallsAnIdleAlarmOnTheWayAndIsNotAwaitedForIt) {
    SteppedClock clock;
    int awaited = 0;
    clock.on_awaited([&] { ++awaited; });
    bool called = false;
    const auto idle = clock.make_idle_alarm();
    idle->set(10ms, [&] { called = true; });
    EXPECT_FALSE(clock.awaited());
    EXPECT_EQ(awaited, 0);
    const auto alarm = clock.make_alarm();
    alarm->set(20ms, [] {});
    EXPECT_TRUE(clock.awaited());
    EXPECT_EQ(awaited, 1);
    clock.advance_to(15ms);
    EXPECT_TRUE(called);
    EXPECT_TRUE(clock.awaited());
    alarm->cancel();
    EXPECT_FALSE(clock.awaited());
}

TEST(SteppedClock, CallsWhatIsOverdueNowAndNotFromWithinSet) {
    SteppedClock clock;
    clock.advance_to(5s);
    bool called = false;
    const auto alarm = clock.make_alarm();
    alarm->set(1s, [&] {
        called = true;
        EXPECT_EQ(clock.now(), 5s);
    });
    EXPECT_FALSE(called);
    clock.advance_to(5s);
    EXPECT_TRUE(called);
}

TEST(SteppedClock, ForgetsWhatIsCancelledReplacedOrGone) {
    SteppedClock clock;
    std::string called;
    const auto alarm = clock.make_alarm();
    auto gone = clock.make_alarm();
    const auto cancelled = clock.make_alarm();
    alarm->set(1s, [&] { called += "replaced"; });
    alarm->set(2s, [&] {
        called += "new";
        gone.reset();
    });
    gone->set(3s, [&] { called += "gone"; });
    cancelled->set(1s, [&] { called += "cancelled"; });
    cancelled->cancel();
    clock.advance_to(10s);
    EXPECT_EQ(called, "new");
}

TEST(SteppedClock, LetsACallTakeItsOwnAlarmAway) {
    SteppedClock clock;
    auto alarm = clock.make_alarm();
    alarm->set(1s, [&] { alarm.reset(); });
    clock.advance_to(2s);
    EXPECT_EQ(alarm, nullptr);
}

TEST(SteppedClock, NeverGoesBack) {
    SteppedClock clock;
    clock.advance_to(2s);
    clock.advance_to(1s);
    EXPECT_EQ(clock.now(), 2s);
}

TEST(SteppedClock, MakesCallsSideBySideThatFollowEachOtherAtOneTime) {
    SteppedClock clock;
    std::string done;
    clock.on_beside([&](const std::vector<SteppedClock::SlowCall>& calls) {
        done += '(';
        for (const SteppedClock::SlowCall& call : calls)
            call.call();
        done += ')';
    });
    bool may = true;
    const auto slow = [&] { return clock.make_slow_alarm({.may = [&may] { return may; }}); };
    const auto call = [&](char name) { return [&done, name] { done += name; }; };
    const std::array alarms{slow(), slow(), clock.make_alarm(), slow(), slow()};
    const auto set_all = [&](sim::Time at) {
        for (std::size_t i = 0; i < alarms.size(); ++i)
            alarms[i]->set(at, call(static_cast<char>('a' + i)));
    };
    set_all(10ms);
    alarms.back()->set(20ms, call('e'));
    clock.advance_to(20ms);
    EXPECT_EQ(done, "(ab)cde");
    set_all(25ms);
    EXPECT_EQ(clock.step(25ms), 2U);
    EXPECT_EQ(clock.step(25ms), 1U);
    clock.advance_to(25ms);
    EXPECT_EQ(clock.step(25ms), 0U);
    done.clear();
    may = false;
    set_all(30ms);
    clock.advance_to(30ms);
    EXPECT_EQ(done, "abcde");
}

TEST(SteppedClock, IsAwaitedAndHeldByCallsThatAreMadeSideBySide) {
    SteppedClock clock;
    clock.on_beside([&](const std::vector<SteppedClock::SlowCall>& calls) {
        for (const SteppedClock::SlowCall& call : calls)
            call.call();
    });
    int awaited = 0;
    int released = 0;
    clock.on_awaited([&] { ++awaited; });
    clock.on_released([&] { ++released; });
    const auto slow = [&] { return clock.make_slow_alarm({.may = [] { return true; }}); };
    const std::array alarms{slow(), slow()};
    for (const auto& alarm : alarms) {
        alarm->set(10ms, [&clock, again = alarm.get()] {
            again->set(20ms, [&clock, again] { clock.hold(again, false); });
            clock.hold(again, true);
        });
    }
    EXPECT_EQ(awaited, 1);
    clock.advance_to(10ms);
    EXPECT_EQ(awaited, 2);
    EXPECT_TRUE(clock.held());
    clock.advance_to(20ms);
    EXPECT_EQ(released, 1);
    EXPECT_FALSE(clock.awaited());
}

}  // namespace
}  // namespace scipd::daemon
