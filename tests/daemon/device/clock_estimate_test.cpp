// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A driver that finds the device's clock as urg_stamped does, by the steps that its README and
// sources describe, in words of our own: many TM1, each taken for answered halfway between request
// and reply. The clock's milliseconds begin where the stamp steps on; two such syncs tell its rate.
// World time is stepped; the driver's host takes its time, as hosts do.
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/models/model_registry.h"
#include "protocol/char_code.h"
#include "tests/daemon/stepped_driver.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

constexpr double true_ppm = 50.0;
constexpr double ms_per_stamp = 1.0;

double milliseconds(sim::Time time) {
    return std::chrono::duration<double, std::milli>(time).count();
}

/// One TM1, in milliseconds of the host's clock.
struct Sample {
    double answered_ms;  ///< halfway
    double half_ms;      ///< of the round trip
    double stamp_ms;

    /// When the device's clock showed 0, if it had shown just that stamp when it answered.
    [[nodiscard]] double origin_ms() const { return answered_ms - stamp_ms; }
};

/// What one sync makes of its samples.
struct Sync {
    double at_ms = 0.0;
    double origin_ms = 0.0;
};

/// The samples whose round trips are hardly longer than the shortest.
std::vector<Sample> prompt(const std::vector<Sample>& samples) {
    const auto half = [](const Sample& sample) { return sample.half_ms; };
    const double shortest = std::ranges::min(samples, {}, half).half_ms;
    double squares = 0.0;
    for (const Sample& sample : samples)
        squares += (sample.half_ms - shortest) * (sample.half_ms - shortest);
    const double limit = shortest + std::sqrt(squares / static_cast<double>(samples.size()));
    std::vector<Sample> kept;
    std::ranges::copy_if(samples, std::back_inserter(kept),
                         [&](const Sample& sample) { return sample.half_ms <= limit; });
    return kept;
}

/// The device answers at once. A stamp is rounded down, so the origin that a sample gives is
/// late by the fraction of its millisecond: the latest origin is from just before a step of the
/// stamp, the earliest from just after one. Nothing: the two are not close together, the steps
/// cannot be seen.
std::optional<Sync> sync_at_steps(const std::vector<Sample>& samples) {
    const std::vector<Sample> kept = prompt(samples);
    constexpr std::size_t fewest = 10;
    if (kept.size() < fewest) return std::nullopt;
    const auto origin = [](const Sample& sample) { return sample.origin_ms(); };
    const auto fraction = [](double ms) { return ms - std::floor(ms); };
    const double after = fraction(std::ranges::min(kept, {}, origin).answered_ms);
    double before = fraction(std::ranges::max(kept, {}, origin).answered_ms);
    if (after > before + ms_per_stamp / 2) before += ms_per_stamp;
    if (before > after + ms_per_stamp / 2) before -= ms_per_stamp;
    if (std::abs(after - before) > ms_per_stamp / 4) return std::nullopt;
    const double step = fraction((after + before) / 2);  // its place in a millisecond of the host's
    const Sample& best =
        std::ranges::min(kept, {}, [](const Sample& sample) { return sample.half_ms; });
    const double late = fraction(best.answered_ms - step);
    return Sync{best.answered_ms, best.origin_ms() - late};
}

/// The device answers on a tick of 5 ms, which is a step of its stamp as well: replies that came
/// almost at once came at that tick.
std::optional<Sync> sync_at_replies(const std::vector<Sample>& samples) {
    std::vector<Sample> kept;
    std::ranges::copy_if(samples, std::back_inserter(kept),
                         [](const Sample& sample) { return sample.half_ms < ms_per_stamp / 2; });
    constexpr std::size_t fewest = 5;
    if (kept.size() < fewest) return std::nullopt;
    const auto origin_of_reply = [](const Sample& sample) {
        return sample.origin_ms() + sample.half_ms;
    };
    std::ranges::sort(kept, {}, origin_of_reply);
    const Sample& median = kept[kept.size() / 2];
    return Sync{median.answered_ms, origin_of_reply(median)};
}

class ClockEstimate : public testing::TestWithParam<Model> {
  protected:
    static SensorConfig sensor() {
        const protocol::DeviceProfile& profile = GetParam().profile;
        SensorConfig config = ideal_sensor(profile.name + "@" + profile.release);
        config.timing = Timing::real;
        config.clock.ppm = true_ppm;
        return config;
    }

    /// What the host needs for a system call and for waking up.
    sim::Time moment() { return std::chrono::microseconds(20 + random_() % 40); }

    Sample ask_time() {
        const sim::Time sent = driver_.now();
        driver_.wait(moment());
        driver_.send("TM1");
        const SteppedDriver::Received reply = driver_.await();
        const sim::Time read = reply.at + moment();
        driver_.wait_until(std::max(read, driver_.now()));
        const double half_ms = milliseconds(read - sent) / 2;
        const auto stamp = protocol::decode(std::string_view(reply.bytes).substr(8, 4));
        return {milliseconds(sent) + half_ms, half_ms, static_cast<double>(stamp.value_or(0))};
    }

    std::optional<Sync> sync() {
        EXPECT_EQ(driver_.ask("TM0"), "TM0\n00P\n\n");
        std::vector<Sample> samples;
        constexpr int most = 100;
        const unsigned widest_pause_us = ticks() ? 5000 : 600;  // at any phase of a tick
        for (int i = 0; i < most; ++i) {
            driver_.wait(std::chrono::microseconds(300 + random_() % widest_pause_us));
            samples.push_back(ask_time());
        }
        EXPECT_EQ(driver_.ask("TM2"), "TM2\n00P\n\n");
        return ticks() ? sync_at_replies(samples) : sync_at_steps(samples);
    }

    [[nodiscard]] bool ticks() const { return driver_.profile().time_tick > 0ms; }

    SteppedDriver driver_{sensor()};
    std::minstd_rand random_{7};
};

TEST_P(ClockEstimate, FindsTheRateAfterTwoSyncs) {
    driver_.wait_until(1s);
    const sim::Time begin = driver_.now();
    const auto first = sync();
    // "at most ~100ms on UTM/UUST1 and ~1s on UUST2", says the README.
    EXPECT_LE(driver_.now() - begin, ticks() ? 1s : 200ms);
    ASSERT_TRUE(first) << "the first sync failed";
    Sync last = *first;
    for (int i = 1; i <= 20; ++i) {
        driver_.wait_until(1s + i * 30s);
        const auto next = sync();
        ASSERT_TRUE(next) << "sync " << i << " failed";
        const double ppm = (last.origin_ms - next->origin_ms) / (next->at_ms - last.at_ms) * 1e6;
        EXPECT_NEAR(ppm, true_ppm, 2.0) << "after sync " << i;
        last = *next;
    }
}

std::vector<Model> ethernet_models() {
    std::vector<Model> all = models();
    std::erase_if(all, [](const Model& model) {
        return model.profile.family != protocol::Family::ethernet_multi_echo &&
               model.profile.family != protocol::Family::ust;
    });
    return all;
}

INSTANTIATE_TEST_SUITE_P(EveryEthernetModel, ClockEstimate, testing::ValuesIn(ethernet_models()),
                         [](const auto& model) {
                             std::string name =
                                 model.param.profile.name + "_" + model.param.profile.release;
                             std::ranges::replace_if(
                                 name, [](char c) { return c == '-' || c == '.'; }, '_');
                             return name;
                         });

}  // namespace
}  // namespace scipd::daemon
