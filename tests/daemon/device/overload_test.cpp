// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Many scan loops on one thread that is too slow for them, in a time of its own: it goes on while a
// source makes a scan, and while nobody has anything to do.
#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/device/pace.h"
#include "daemon/device/scan_loop.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

/// Calls late where calls take time, those first that are due first.
class BusyClock : public Clock {
  public:
    [[nodiscard]] sim::Time now() const override { return now_; }
    [[nodiscard]] std::unique_ptr<Alarm> make_alarm() override {
        return std::make_unique<QueuedAlarm>(*this);
    }
    /// The thread works, or its machine does something else.
    void spend(sim::Time time) { now_ += time; }
    void run_until(sim::Time end) {
        while (!queue_.empty() && std::max(now_, queue_.begin()->first) < end) {
            const auto [at, alarm] = *queue_.begin();
            now_ = std::max(now_, at);
            const Call call = std::exchange(alarm->call, nullptr);
            alarm->cancel();
            call();
        }
        now_ = std::max(now_, end);
    }

  private:
    struct QueuedAlarm : Alarm {
        explicit QueuedAlarm(BusyClock& busy) : clock(busy) {}
        ~QueuedAlarm() override { cancel(); }
        void set(sim::Time at, Call then) override {
            cancel();
            clock.queue_.emplace(at, this);
            call = std::move(then);
        }
        void cancel() override {
            std::erase_if(clock.queue_, [&](const auto& entry) { return entry.second == this; });
        }
        BusyClock& clock;
        Call call;
    };

    sim::Time now_{};
    std::multimap<sim::Time, QueuedAlarm*> queue_;
};

constexpr sim::Time a_turn = 25ms;

/// Its scans are wanted for ever, and each takes the thread some time.
class Source : public ScanSource {
  public:
    Source(BusyClock& clock, sim::Time phase, sim::Time cost)
        : clock_(clock), phase_(phase), cost_(cost) {}

    [[nodiscard]] const std::string& name() const override { return name_; }
    [[nodiscard]] bool driven() const override { return true; }
    [[nodiscard]] bool watched() const override { return false; }
    void on_wanted(std::function<void()> callback) override {
        if (callback) callback();
    }
    [[nodiscard]] std::int64_t next_revolution() const override {
        return clock_.now() < phase_ ? 0 : (clock_.now() - phase_) / a_turn + 1;
    }
    [[nodiscard]] sim::Time leaves(std::int64_t revolution) const override {
        return phase_ + revolution * a_turn;
    }
    [[nodiscard]] sim::Time patience() const override { return {}; }
    [[nodiscard]] bool poses_known(std::int64_t) const override { return true; }
    void turn_complete(std::int64_t revolution) override {
        served.push_back(revolution);
        lateness.push_back(clock_.now() - leaves(revolution));
        clock_.spend(cost_);
    }
    /// From this turn on: how many in a row were left out at most.
    [[nodiscard]] std::int64_t widest_gap(std::int64_t from) const {
        std::int64_t widest = 0;
        for (std::size_t i = 1; i < served.size(); ++i) {
            if (served[i - 1] >= from) widest = std::max(widest, served[i] - served[i - 1] - 1);
        }
        return widest;
    }

    std::vector<std::int64_t> served;
    std::vector<sim::Time> lateness;

  private:
    std::string name_ = "robot/scanner";
    BusyClock& clock_;
    sim::Time phase_;
    sim::Time cost_;
};

/// Twenty scanners that together ask for so much of the thread's time.
class Crowd {
  public:
    static constexpr int size = 20;

    explicit Crowd(double load) {
        const auto cost = std::chrono::duration_cast<sim::Time>(a_turn * load / size);
        for (int i = 0; i < size; ++i) {
            sources.push_back(std::make_unique<Source>(clock, i * a_turn / size, cost));
            loops.push_back(std::make_unique<ScanLoop>(*sources.back(), clock));
        }
    }
    [[nodiscard]] std::vector<std::uint64_t> missed() const {
        std::vector<std::uint64_t> each;
        for (const auto& loop : loops)
            each.push_back(loop->missed());
        return each;
    }

    BusyClock clock;
    std::vector<std::unique_ptr<Source>> sources;
    std::vector<std::unique_ptr<ScanLoop>> loops;
};

/// What is lost in a minute, of 2400 turns, and that it is lost evenly.
void expect_even_losses(double load) {
    Crowd crowd(load);
    crowd.clock.run_until(60s);
    const auto missed = crowd.missed();
    const auto [least, most] = std::ranges::minmax(missed);
    EXPECT_NEAR(static_cast<double>(least), 2400.0 * (1.0 - 1.0 / load), 80.0);
    EXPECT_LT(static_cast<double>(most), 1.05 * static_cast<double>(least));
    const std::int64_t after_a_while = 10s / a_turn;
    const auto few = static_cast<std::int64_t>(load);
    for (const auto& source : crowd.sources) {
        EXPECT_LE(source->widest_gap(0), 8 + few);
        EXPECT_LE(source->widest_gap(after_a_while), few);
        for (std::size_t i = 0; i < source->served.size(); ++i) {
            const sim::Time bound = source->served[i] < after_a_while ? 1s + few * a_turn : a_turn;
            ASSERT_LE(source->lateness[i], bound) << source->served[i];
        }
    }
}

TEST(Overload, TakesScansOfAllEvenly) {
    for (const double load : {1.3, 2.0, 3.7, 6.0}) {
        SCOPED_TRACE(load);
        expect_even_losses(load);
    }
}

TEST(Overload, ThatPassesWithinASecondLosesNothing) {
    Crowd crowd(0.8);
    for (int i = 1; i <= 5; ++i) {
        crowd.clock.run_until(i * 10s);
        crowd.clock.spend(900ms);
    }
    crowd.clock.run_until(60s);
    for (const auto& source : crowd.sources)
        EXPECT_GE(source->served.back(), source->next_revolution() - 2);
    EXPECT_EQ(std::ranges::max(crowd.missed()), 0U);
}

TEST(Overload, ThatHasPassedIsForgotten) {
    Crowd crowd(0.5);
    crowd.clock.run_until(10s);
    crowd.clock.spend(1500ms);
    crowd.clock.run_until(30s);
    const auto missed = crowd.missed();
    EXPECT_GT(std::ranges::min(missed), 20U);
    EXPECT_LT(std::ranges::max(missed), 60U);
    crowd.clock.spend(900ms);
    crowd.clock.run_until(60s);
    EXPECT_EQ(crowd.missed(), missed);
}

// A laptop that was closed for a night.
TEST(Overload, OfAMachineThatSleptGivesUpAllThatIsOld) {
    Crowd crowd(0.5);
    crowd.clock.run_until(10s);
    crowd.clock.spend(std::chrono::hours(8));
    const sim::Time awake = crowd.clock.now();
    crowd.clock.run_until(awake + 10s);
    for (const auto& source : crowd.sources) {
        EXPECT_LE(std::ranges::max(source->lateness), 1s);
        EXPECT_GE(source->served.back(), source->next_revolution() - 2);
    }
}

TEST(ScanLosses, AreToldNowAndThenForAllSensors) {
    ScanLosses losses;
    const ScanLosses::Time start{};
    EXPECT_TRUE(losses.add("r/a", 1, start).value().starts_with("r/a lost 1 scan: "));
    EXPECT_EQ(losses.add("r/a", 2, start + 1s), std::nullopt);
    EXPECT_EQ(losses.add("r/b", 3, start + 9s), std::nullopt);
    EXPECT_TRUE(losses.add("r/c", 4, start + 10s)
                    .value()
                    .starts_with("r/c and 2 other sensors lost 9 scans: "));
    EXPECT_EQ(losses.add("r/c", 5, start + 19s), std::nullopt);
    EXPECT_TRUE(losses.add("r/c", 5, start + 21s).value().starts_with("r/c lost 10 scans: "));
}

}  // namespace
}  // namespace scipd::daemon
