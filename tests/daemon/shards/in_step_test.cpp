// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Shards on a stepped clock: they live on one thread, and only what is done ahead is done on more.
#include <chrono>
#include <condition_variable>
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
    /// An alarm of this shard whose call and whose work ahead of it do nothing else.
    std::unique_ptr<Clock::Alarm> alarm(std::size_t shard, std::function<void()> work,
                                        sim::Time at = 10ms) {
        auto alarm = clock_.make_slow_alarm({.shard = shard, .work = std::move(work)});
        alarm->set(at, [] {});
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
TEST_F(ShardsInStep, WorkSideBySide) {
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

TEST_F(ShardsInStep, DoWhatIsOfOneShardInOrder) {
    std::string done;
    const std::vector alarms{std::shared_ptr(alarm(1, [&] { done += 'a'; })),
                             std::shared_ptr(alarm(0, [] {})),
                             std::shared_ptr(alarm(1, [&] { done += 'b'; }))};
    clock_.advance_to(10ms);
    EXPECT_EQ(done, "ab");
}

TEST_F(ShardsInStep, AreToldHomeAfterTheWork) {
    std::string told;
    const auto tell = [&] { shards_.call_home([&] { told += '.'; }); };
    const std::vector alarms{std::shared_ptr(alarm(0, tell)), std::shared_ptr(alarm(1, tell))};
    clock_.advance_to(10ms);
    EXPECT_EQ(told, "");
    io_.run();
    EXPECT_EQ(told, "..");
}

TEST_F(ShardsInStep, ThrowWhatTheWorkThrows) {
    const auto fail = [] { throw std::runtime_error("no driver"); };
    const std::vector alarms{std::shared_ptr(alarm(0, [] {})), std::shared_ptr(alarm(2, fail))};
    EXPECT_THROW(clock_.advance_to(10ms), std::runtime_error);
}

}  // namespace
}  // namespace scipd::daemon
