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

    boost::asio::io_context io_;
    SteppedClock clock_;
    World world_;
    Shards shards_{io_.get_executor(), world_, clock_, 3};
};

TEST_F(ShardsInStep, KnowAtOnceWhatChanges) {
    std::multiset<std::size_t> changed;
    shards_.on_changed([&](std::size_t shard) { changed.insert(shard); });
    world_.set_robots({{"r", {}}});
    changed.clear();
    ASSERT_TRUE(world_.place_robot("r", {1s, sim::pose_from_rpy({5, 0, 0}, {0, 0, 0}), {}, false}));
    EXPECT_THAT(changed, ElementsAre(0, 1, 2));
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
