// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Shards on a stepped clock: they live on one thread, and only calls that stand alone are made on
// more.
#include <chrono>
#include <condition_variable>
#include <future>
#include <memory>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/shards/shards.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

class ShardsInStep : public testing::Test {
  protected:
    /// Its call stands alone.
    std::unique_ptr<Clock::Alarm> alarm(std::size_t shard, Clock::Call call) {
        auto alarm = clock_.make_slow_alarm({.shard = shard, .may = [] { return true; }});
        alarm->set(10ms, std::move(call));
        return alarm;
    }

    static Placement at(sim::Time time, double x_m) {
        return {time, sim::pose_from_rpy({x_m, 0, 0}, {0, 0, 0}), {}, false};
    }

    boost::asio::io_context io_;
    SteppedClock clock_;
    World world_;
    Shards shards_{io_.get_executor(), world_, clock_, 3};
};

TEST_F(ShardsInStep, KnowOfRobotsAtOnce) {
    world_.set_robots({{"r", {}}});
    for (std::size_t i = 0; i < shards_.size(); ++i)
        EXPECT_NE(shards_.at(i).world.robot("r"), nullptr);
}

// A few poses are copied by one thread, many by all.
TEST_F(ShardsInStep, KnowOfPosesBeforeTheClockGoesOn) {
    world_.set_robots({{"r", {}}});
    std::multiset<std::size_t> changed;
    shards_.on_changed([&](std::size_t shard) { changed.insert(shard); });
    for (const int poses : {1, 200}) {
        changed.clear();
        const sim::Time begin = clock_.now();
        for (int i = 1; i <= poses; ++i)
            ASSERT_TRUE(world_.place_robot("r", at(begin + i * 1ms, i)));
        std::multiset<double> seen;
        const auto look = clock_.make_alarm();
        look->set(begin, [&] {
            for (std::size_t i = 0; i < shards_.size(); ++i)
                seen.insert(shards_.at(i).world.robot("r")->at(1h).translation_m.x);
        });
        clock_.advance_to(begin + 1s);
        EXPECT_THAT(seen, ElementsAre(poses, poses, poses));
        EXPECT_THAT(changed, ElementsAre(0, 1, 2)) << "once for all poses";
    }
}

TEST_F(ShardsInStep, KnowOfPosesWhenTheyAreLookedAt) {
    world_.set_robots({{"r", {}}});
    ASSERT_TRUE(world_.place_robot("r", at(1s, 5)));
    shards_.still([&] {
        for (std::size_t i = 0; i < shards_.size(); ++i)
            EXPECT_EQ(shards_.at(i).world.robot("r")->at(1h).translation_m.x, 5.0);
    });
}

// A fault that stops a robot asks where it is, in the moment in which its trajectory begins.
TEST_F(ShardsInStep, KnowOfPosesThatComeInAMomentOfStillness) {
    world_.set_robots({{"r", {}}});
    const auto seen_m = [&](std::size_t shard) {
        double x_m = 0;
        shards_.still_on(shard,
                         [&] { x_m = shards_.at(shard).world.robot("r")->at(1h).translation_m.x; });
        return x_m;
    };
    shards_.still([&] {
        ASSERT_TRUE(world_.place_robot("r", at(1s, 5)));
        for (std::size_t i = 0; i < shards_.size(); ++i)
            EXPECT_EQ(seen_m(i), 5.0);
    });
}

// The clock may be held, and others look meanwhile.
TEST_F(ShardsInStep, KnowOfPosesSoonEvenIfTheClockStands) {
    world_.set_robots({{"r", {}}});
    ASSERT_TRUE(world_.place_robot("r", at(1s, 5)));
    io_.run();
    for (std::size_t i = 0; i < shards_.size(); ++i)
        EXPECT_EQ(shards_.at(i).world.robot("r")->at(1h).translation_m.x, 5.0);
}

// Each of the three waits until all have begun.
TEST_F(ShardsInStep, CallSideBySide) {
    std::mutex mutex;
    std::condition_variable changed;
    int begun = 0;
    std::set<std::thread::id> threads;
    const auto meet = [&] {
        std::unique_lock lock(mutex);
        ++begun;
        threads.insert(std::this_thread::get_id());
        changed.notify_all();
        EXPECT_TRUE(changed.wait_for(lock, 20s, [&] { return begun == 3; }));
    };
    const std::vector alarms{std::shared_ptr(alarm(0, meet)), std::shared_ptr(alarm(1, meet)),
                             std::shared_ptr(alarm(2, meet))};
    clock_.advance_to(10ms);
    EXPECT_EQ(threads.size(), 3U);
    EXPECT_TRUE(threads.contains(std::this_thread::get_id()));
}

TEST_F(ShardsInStep, MakeCallsOfOneShardInOrder) {
    std::string done;
    const std::vector alarms{std::shared_ptr(alarm(1, [&] { done += 'a'; })),
                             std::shared_ptr(alarm(0, [] {})),
                             std::shared_ptr(alarm(1, [&] { done += 'b'; }))};
    clock_.advance_to(10ms);
    EXPECT_EQ(done, "ab");
}

// The second call is over before the first one goes on.
TEST_F(ShardsInStep, LeaveNothingToTheOrderOfThreads) {
    std::string told;
    std::promise<void> second_is_over;
    const auto first_set = clock_.make_alarm();
    const auto second_set = clock_.make_alarm();
    const auto tell = [&told, home = std::this_thread::get_id()](char name) {
        return [&told, name, home] {
            EXPECT_EQ(std::this_thread::get_id(), home);
            told += name;
        };
    };
    const std::vector alarms{std::shared_ptr(alarm(0,
                                                   [&] {
                                                       second_is_over.get_future().wait_for(20s);
                                                       shards_.call_home(tell('a'));
                                                       first_set->set(20ms, tell('c'));
                                                   })),
                             std::shared_ptr(alarm(1, [&] {
                                 shards_.call_home(tell('b'));
                                 second_set->set(20ms, tell('d'));
                                 second_is_over.set_value();
                             }))};
    clock_.advance_to(10ms);
    EXPECT_EQ(told, "ab");
    clock_.advance_to(20ms);
    EXPECT_EQ(told, "abcd");
}

TEST_F(ShardsInStep, ThrowWhatACallThrows) {
    const auto fail = [] { throw std::runtime_error("no driver"); };
    const std::vector alarms{std::shared_ptr(alarm(0, [] {})), std::shared_ptr(alarm(2, fail))};
    EXPECT_THROW(clock_.advance_to(10ms), std::runtime_error);
}

}  // namespace
}  // namespace scipd::daemon
