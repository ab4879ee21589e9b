// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/shards/shards.h"

#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

class ShardsTest : public testing::TestWithParam<std::size_t> {
  protected:
    /// A handler that is always there again, and counts without a lock.
    struct Busy {
        explicit Busy(const Shard& where) : shard(where) { go_on(); }
        void go_on() {
            boost::asio::post(shard.executor, [this] {
                ++count;
                if (!ended) go_on();
            });
        }
        const Shard& shard;
        std::uint64_t count = 0;
        bool ended = false;
    };

    void make_busy() {
        for (std::size_t i = 0; i < shards_.size(); ++i)
            busy_.push_back(std::make_unique<Busy>(shards_.at(i)));
    }
    void run() { io_.run_for(20ms); }
    ~ShardsTest() override {
        shards_.still([&] {
            for (auto& busy : busy_)
                busy->ended = true;
        });
        run();
        shards_.join();
    }

    [[nodiscard]] std::vector<double> xs() {
        std::vector<double> xs;
        for (std::size_t i = 0; i < shards_.size(); ++i)
            xs.push_back(shards_.at(i).world.robot("r")->at(1h).translation_m.x);
        return xs;
    }
    void place(double x_m, sim::Time time) {
        ASSERT_TRUE(
            world_.place_robot("r", {time, sim::pose_from_rpy({x_m, 0, 0}, {0, 0, 0}), {}, false}));
    }

    boost::asio::io_context io_;
    boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_{
        io_.get_executor()};
    WallClock clock_{io_.get_executor()};
    std::atomic<int> told_ = 0;
    World world_;
    Shards shards_{io_.get_executor(), world_, clock_, GetParam()};
    std::vector<std::unique_ptr<Busy>> busy_;
};

INSTANTIATE_TEST_SUITE_P(Threads, ShardsTest, testing::Values(1, 2, 5),
                         testing::PrintToStringParamName());

TEST_P(ShardsTest, AreAsManyAsWereAskedFor) {
    EXPECT_EQ(shards_.size(), GetParam());
}

// Counts that go on while they are looked at differ.
TEST_P(ShardsTest, StandStillWhileSomebodyLooks) {
    make_busy();
    std::uint64_t before = 0;
    for (int look = 0; look < 200; ++look) {
        if (GetParam() == 1) io_.poll_one();
        shards_.still([&] {
            std::array<std::uint64_t, 3> sums{};
            for (auto& sum : sums) {
                for (const auto& busy : busy_)
                    sum += busy->count;
                std::this_thread::yield();
            }
            EXPECT_EQ(sums.front(), sums.back());
            EXPECT_GE(sums.front(), before);
            before = sums.front();
        });
    }
    run();
    shards_.still([&] {
        for (const auto& busy : busy_)
            EXPECT_GT(busy->count, 0U);
    });
}

struct Turns {
    std::atomic<int> count = 0;
    std::atomic<bool> ended = false;
};

void take_turns(const std::shared_ptr<Turns>& turns, const Shard& shard) {
    boost::asio::post(shard.executor, [turns, &shard] {
        ++turns->count;
        if (!turns->ended) take_turns(turns, shard);
    });
}

/// Turns that shard 1 takes while somebody waits for shard 0, which draws a picture.
int turns_beside_a_picture(Shards& shards) {
    const auto turns = std::make_shared<Turns>();
    take_turns(turns, shards.at(1));
    std::atomic<bool> draws = false;
    std::atomic<bool> waits = false;
    int meanwhile = 0;
    boost::asio::post(shards.at(0).executor, [&] {
        draws = true;
        while (!waits)
            std::this_thread::yield();
        std::this_thread::sleep_for(50ms);
        const int before = turns->count;
        std::this_thread::sleep_for(100ms);
        meanwhile = turns->count - before;
    });
    while (!draws)
        std::this_thread::yield();
    waits = true;
    shards.still([&] {
        const int then = turns->count;
        std::this_thread::sleep_for(20ms);
        EXPECT_EQ(turns->count, then);
    });
    turns->ended = true;
    return meanwhile;
}

// A camera's picture takes long. Whoever has no core is taken for late as well, hence the tries.
TEST_P(ShardsTest, LetOthersGoOnUntilTheLateOneStandsStill) {
    if (GetParam() == 1) GTEST_SKIP();
    int turns = 0;
    for (int i = 0; i < 20 && turns == 0; ++i)
        turns = turns_beside_a_picture(shards_);
    EXPECT_GT(turns, 0);
}

// What is stuck can be named, although nothing else goes on.
TEST_P(ShardsTest, TellWhichOfThemDoesNotStandStill) {
    std::vector<std::size_t> late;
    shards_.on_late([&](std::size_t shard) { late.push_back(shard); });
    const std::size_t last = shards_.size() - 1;
    boost::asio::post(shards_.at(last).executor, [] { std::this_thread::sleep_for(3500ms); });
    run();
    shards_.still([] {});
    EXPECT_EQ(late, shards_.size() > 1 ? std::vector{last} : std::vector<std::size_t>{});
    shards_.still([] {});
    EXPECT_LE(late.size(), 1U);
    shards_.on_late([](std::size_t) {});
}

TEST_P(ShardsTest, MayBeAskedToStandStillWhileTheyDo) {
    make_busy();
    EXPECT_EQ(shards_.still([&] { return shards_.still([] { return 42; }); }), 42);
}

TEST_P(ShardsTest, SeeEachChangeThatTheyMustNotMissBeforeAnybodyGoesOn) {
    make_busy();
    for (int i = 1; i < 50; ++i) {
        world_.set_robots(
            {{"r", {.world_from_robot = sim::pose_from_rpy({double(i), 0, 0}, {0, 0, 0})}}});
        shards_.still([&] { EXPECT_THAT(xs(), testing::Each(i)); });
    }
}

TEST_P(ShardsTest, TakePosesInTheirOrder) {
    make_busy();
    world_.set_robots({{"r", {}}});
    for (int i = 1; i <= 1000; ++i) {
        place(i, i * 1ms);
        if (i % 7 == 0) io_.poll_one();
    }
    shards_.still([&] { EXPECT_THAT(xs(), testing::Each(1000.0)); });
}

TEST_P(ShardsTest, TakePosesOfAMomentOfStillnessBeforeTheNextChange) {
    make_busy();
    world_.set_robots({{"r", {}}});
    shards_.still([&] {
        place(7, 1ms);
        place(8, 2ms);
        world_.set_media({});
        EXPECT_THAT(xs(), testing::Each(8.0));
        place(9, 3ms);
    });
    shards_.still([&] { EXPECT_THAT(xs(), testing::Each(9.0)); });
}

TEST_P(ShardsTest, AreToldOfPosesOnTheirThread) {
    shards_.on_changed([&](std::size_t shard) {
        EXPECT_LT(shard, GetParam());
        ++told_;
    });
    world_.set_robots({{"r", {}}});
    place(1, 1ms);
    io_.poll();
    const auto end = std::chrono::steady_clock::now() + 10s;
    while (told_ < static_cast<int>(GetParam()) && std::chrono::steady_clock::now() < end)
        std::this_thread::yield();
    EXPECT_GE(told_, static_cast<int>(GetParam()));
}

TEST_P(ShardsTest, ThrowOnTheThreadOfWhoeverRunsThem) {
    const std::size_t last = shards_.size() - 1;
    boost::asio::post(shards_.at(last).executor, [] { throw std::runtime_error("a bug"); });
    EXPECT_THROW(io_.run_for(10s), std::runtime_error);
    EXPECT_EQ(shards_.still([] { return 1; }), 1);
}

TEST_P(ShardsTest, CallHome) {
    const auto here = std::this_thread::get_id();
    bool called = false;
    boost::asio::post(shards_.at(shards_.size() - 1).executor, [&] {
        shards_.call_home([&] {
            called = std::this_thread::get_id() == here;
            io_.stop();
        });
    });
    io_.run_for(10s);
    EXPECT_TRUE(called);
}

TEST_P(ShardsTest, TellTheSameTime) {
    const sim::Time now = clock_.now();
    for (std::size_t i = 0; i < shards_.size(); ++i)
        EXPECT_LT(shards_.at(i).clock.now() - now, 10s);
}

// With one thread, sweeps are handlers as all others.
TEST_P(ShardsTest, LetNoReplyWaitForMoreThanOneSweep) {
    if (GetParam() == 1) GTEST_SKIP();
    const Shard& shard = shards_.at(0);
    std::atomic<int> swept = 0;
    std::vector<std::unique_ptr<Clock::Alarm>> alarms;
    shards_.still([&] {
        for (int i = 0; i < 50; ++i) {
            alarms.push_back(shard.clock.make_slow_alarm({}));
            alarms.back()->set(shard.clock.now(), [&] {
                std::this_thread::sleep_for(2ms);
                ++swept;
            });
        }
    });
    for (int request = 0; request < 5; ++request) {
        while (swept < 5 * request + 1)
            std::this_thread::yield();
        const int before = swept;
        std::atomic<int> at_reply = -1;
        boost::asio::post(shard.executor, [&] { at_reply = swept.load(); });
        while (at_reply < 0)
            std::this_thread::yield();
        EXPECT_LE(at_reply, before + 1);
    }
    shards_.still([&] { alarms.clear(); });
    EXPECT_LT(swept, 50);
}

TEST_P(ShardsTest, SweepAndAnswerBesideOneWhoNeverStopsAsking) {
    if (GetParam() == 1) GTEST_SKIP();
    struct Sweeper {
        void sweep() {
            ++swept;
            boost::asio::post(shard.executor, [this] { ++answered; });
            if (!over) alarm->set(shard.clock.now(), [this] { sweep(); });
        }
        const Shard& shard;
        std::unique_ptr<Clock::Alarm> alarm = shard.clock.make_slow_alarm({});
        int swept = 0;
        int answered = 0;
        bool over = false;
    };
    Sweeper sweeper{shards_.at(0)};
    shards_.still([&] { sweeper.sweep(); });
    constexpr int times = 1000;
    for (int i = 0; i < times; ++i)
        shards_.still([] {});
    // A sweep waits for its timer, and gives way once.
    EXPECT_GE(shards_.still([&] { return sweeper.swept; }), times / 10);
    EXPECT_LE(shards_.still([&] { return sweeper.swept - sweeper.answered; }), 2);
    shards_.still([&] { sweeper.over = true; });
    while (shards_.still([&] { return sweeper.swept > sweeper.answered; }))
        std::this_thread::yield();
    shards_.still([&] { sweeper.alarm.reset(); });
}

TEST_P(ShardsTest, DoOnTheirThreadWhatIsAskedForThere) {
    make_busy();
    std::set<std::thread::id> threads;
    for (std::size_t i = 0; i < shards_.size(); ++i) {
        std::thread::id first;
        std::thread::id second;
        shards_.still_on(i, [&] { first = std::this_thread::get_id(); });
        shards_.still_on(i, [&] { second = std::this_thread::get_id(); });
        EXPECT_EQ(first, second);
        threads.insert(first);
    }
    EXPECT_EQ(threads.size(), shards_.size());
    EXPECT_EQ(threads.contains(std::this_thread::get_id()), shards_.size() == 1);
}

TEST_P(ShardsTest, DoOnTheirThreadWhatIsAskedForWhileAllStandStill) {
    make_busy();
    for (std::size_t i = 0; i < shards_.size(); ++i) {
        bool done = false;
        shards_.still([&] { shards_.still_on(i, [&] { done = true; }); });
        EXPECT_TRUE(done);
    }
}

TEST_P(ShardsTest, SeeOnTheirThreadWhatHasChangedMeanwhile) {
    world_.set_robots({{"r", {}}});
    double x_m = 0;
    const auto expect_seen = [&] {
        ++x_m;
        const sim::Pose there = sim::pose_from_rpy({x_m, 0, 0}, {0, 0, 0});
        ASSERT_TRUE(world_.place_robot(
            "r", {std::chrono::seconds(static_cast<int>(x_m)), there, {}, false}));
        for (std::size_t i = 0; i < shards_.size(); ++i) {
            shards_.still_on(
                i, [&] { EXPECT_EQ(shards_.at(i).world.robot("r")->at(1h).translation_m.x, x_m); });
        }
    };
    expect_seen();
    shards_.still(expect_seen);
}

TEST_P(ShardsTest, HoldUpNoOtherForWhatIsAskedForOnOneThread) {
    if (GetParam() == 1) GTEST_SKIP();
    const auto turns = std::make_shared<Turns>();
    take_turns(turns, shards_.at(1));
    shards_.still_on(0, [&] {
        const int before = turns->count;
        const auto patience = std::chrono::steady_clock::now() + 10s;
        while (turns->count == before && std::chrono::steady_clock::now() < patience)
            std::this_thread::sleep_for(1ms);
        EXPECT_GT(turns->count, before);
    });
    turns->ended = true;
}

TEST_P(ShardsTest, StandStillForWhatIsQuickAlone) {
    EXPECT_FALSE(sim::MustBeQuick::here());
    shards_.still([] { EXPECT_TRUE(sim::MustBeQuick::here()); });
    shards_.still_on(0, [] { EXPECT_TRUE(sim::MustBeQuick::here()); });
    EXPECT_FALSE(sim::MustBeQuick::here());
}

TEST_P(ShardsTest, MayBeLookedAtWhenTheyHaveEnded) {
    shards_.join();
    EXPECT_EQ(shards_.still([] { return 1; }), 1);
    world_.set_robots({{"r", {}}});
}

}  // namespace
}  // namespace scipd::daemon
