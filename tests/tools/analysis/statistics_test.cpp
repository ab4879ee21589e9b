// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Statistics of scans against closed form, and against scans worked out by hand.
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "tools/analysis/beam_statistics.h"
#include "tools/analysis/blocks.h"
#include "tools/analysis/stamp_statistics.h"

namespace scipd::tools {
namespace {

using testing::ElementsAre;
using testing::Pair;

sim::RecordedScan scan_of(std::vector<double> ranges, std::uint32_t stamp_ms) {
    sim::RecordedScan scan;
    scan.ranges = std::move(ranges);
    scan.stamp_ms = stamp_ms;
    return scan;
}

ScanTable series_of(const std::vector<std::vector<double>>& scans) {
    ScanTable series;
    std::uint32_t stamp_ms = 0;
    for (const auto& ranges : scans)
        series.add(scan_of(ranges, stamp_ms += 25));
    return series;
}

TEST(BeamStatistics, AreThoseOfTheBook) {
    const ScanTable series = series_of({{1002, 5000}, {1004, 0}, {1004, 5000}, {1010, 0}});
    const auto beams = beam_statistics(series, all_scans(series));
    EXPECT_DOUBLE_EQ(beams[0].mean_mm, 1005);
    EXPECT_DOUBLE_EQ(beams[0].sd_mm, std::sqrt(36.0 / 3));
    EXPECT_DOUBLE_EQ(beams[0].median_mm, 1004);
    EXPECT_DOUBLE_EQ(beams[0].quiet_sd_mm, 1.483);  // the middle of 2, 0, 0, 6 is 1
    EXPECT_DOUBLE_EQ(beams[1].share, 0.5);
    EXPECT_DOUBLE_EQ(beams[1].sd_mm, 0);
    EXPECT_TRUE(std::isnan(beams[0].intensity));
    EXPECT_THAT(code_shares(series), ElementsAre(Pair(codes::nothing, 0.25)));
}

TEST(BeamStatistics, KnowEdgesAndMixedPixels) {
    const ScanTable series = series_of({{1000, 1000, 1500, 3000, 3000},  //
                                        {1000, 1000, 1000, 3000, 3000},
                                        {1000, 1000, 3000, 3000, 3000},
                                        {1000, 1000, 2000, 3000, 3000}});
    const auto beams = beam_statistics(series, all_scans(series));
    EXPECT_THAT(beside_edges(beams), ElementsAre(false, true, true, true, false));
    EXPECT_DOUBLE_EQ(mixed_share(series, beams, all_scans(series)), 2.0 / 20);
}

/// Noise of which each beam has a share in its neighbours': the mean of three by 1 : 2 : 1.
ScanTable smoothed_series(std::uint32_t seed) {
    std::mt19937 chance(seed);
    std::normal_distribution<double> normal(0, 20);
    std::vector<std::vector<double>> scans;
    for (int i = 0; i < 400; ++i) {
        std::vector<double> white(102);
        for (double& value : white)
            value = normal(chance);
        std::vector<double> ranges;
        for (std::size_t k = 1; k + 1 < white.size(); ++k)
            ranges.push_back(3000 + white[k - 1] / 4 + white[k] / 2 + white[k + 1] / 4);
        scans.push_back(ranges);
    }
    return series_of(scans);
}

TEST(SharedNoise, IsTheCorrelationOfTheFilter) {
    const ScanTable series = smoothed_series(1);
    const auto beams = beam_statistics(series, all_scans(series));
    const std::vector<bool> smooth(beams.size(), false);
    const auto of = [&](std::size_t apart) {
        return shared_noise(series, beams, smooth, all_scans(series), apart).correlation();
    };
    EXPECT_NEAR(of(1), 4.0 / 6, 0.01);
    EXPECT_NEAR(of(2), 1.0 / 6, 0.01);
    EXPECT_NEAR(of(3), 0, 0.01);
    EXPECT_NEAR(beams[50].sd_mm, 20 * std::sqrt(6.0 / 16), 0.6);
}

TEST(Blocks, HoldEachScanOnce) {
    for (const std::size_t scans : {1U, 7U, 20U, 21U, 100U, 333U, 5000U}) {
        std::size_t at = 3;
        for (const ScanSpan& block : blocks_of({3, 3 + scans})) {
            EXPECT_EQ(block.first, at);
            EXPECT_GT(block.count(), 0U);
            at = block.end;
        }
        EXPECT_EQ(at, 3 + scans);
    }
}

TEST(Bootstrap, KnowsTheMeanAsWellAsTheBookDoes) {
    std::mt19937 chance(5);
    std::normal_distribution<double> normal(0, 3);
    std::vector<double> values(40);
    for (double& value : values)
        value = normal(chance);
    double sum = 0;
    double squares = 0;
    for (const double value : values) {
        sum += value / 40;
        squares += value * value / 40;
    }
    const double deviation = std::sqrt((squares - sum * sum) / 40);
    const auto mean = [&](const Draw& draw, const Draw&) {
        double drawn = 0;
        for (std::size_t i = 0; i < draw.size(); ++i)
            drawn += draw[i] * values[i] / 40;
        return drawn;
    };
    const Interval interval = bootstrap(40, 1, mean);
    EXPECT_NEAR(interval.low, sum - 1.96 * deviation, 0.25 * deviation);
    EXPECT_NEAR(interval.high, sum + 1.96 * deviation, 0.25 * deviation);
    EXPECT_EQ(bootstrap(40, 1, mean).low, interval.low) << "always the same";
}

/// Stamps in whole milliseconds of a clock that is this much too fast, and a host that is late by
/// up to a millisecond.
std::vector<ScanTime> times_of(double period_s, double ppm, int scans) {
    std::mt19937 chance(3);
    std::uniform_real_distribution<double> late_s(0, 0.001);
    std::vector<ScanTime> times;
    for (int i = 0; i < scans; ++i) {
        const double stamp_s = 0.0004 + i * period_s * (1 + ppm / 1e6);
        times.push_back({std::floor(1e3 * stamp_s) / 1e3, 5 + i * period_s + late_s(chance)});
    }
    return times;
}

TEST(StampStatistics, KnowTheRateAndTheJitter) {
    std::vector<ScanTime> times = times_of(0.025, 0, 101);
    times.erase(times.begin() + 40, times.begin() + 50);  // scans that are missing are no jitter
    const StampStatistics statistics = stamp_statistics(times, 1e-3);
    EXPECT_TRUE(statistics.by_scanner);
    EXPECT_NEAR(*statistics.rate_hz, 40, 1e-6);
    EXPECT_NEAR(*statistics.jitter_ms, 0, 1e-6);
}

TEST(StampStatistics, KnowTheClockWithinItsUncertainty) {
    for (const double period_s : {0.025, 0.02505, 0.1}) {
        for (const double ppm : {-200.0, 0.0, 30.0, 100.0}) {
            for (const int scans : {60, 400, 2400}) {
                const auto clock = stamp_statistics(times_of(period_s, ppm, scans), 1e-3).clock;
                ASSERT_TRUE(clock);
                EXPECT_NEAR(clock->ppm, ppm, clock->uncertainty_ppm)
                    << period_s << " s, " << ppm << " ppm, " << scans << " scans";
            }
        }
    }
    EXPECT_LT(stamp_statistics(times_of(0.02505, 0, 2400), 1e-3).clock->uncertainty_ppm, 20);
}

/// Asked forty times; the clock runs as fast as ours, and is 1000 s behind. It reads its time after
/// `before_s` of the `before_s + after_s` from question to answer.
std::vector<ClockAnswer> answers_from(double begin_s, double before_s, double after_s) {
    std::vector<ClockAnswer> answers;
    for (double asked_s = begin_s; answers.size() < 40;) {
        const double device_s = std::floor((asked_s + before_s - 1000) * 1e3) / 1e3;
        answers.push_back({device_s, asked_s, asked_s + before_s + after_s});
        asked_s += before_s + after_s + 0.00137;
    }
    return answers;
}

TEST(ClockReading, KnowsTheRateWithinItsUncertainty) {
    const auto before = clock_reading(answers_from(2000, 1e-4, 1e-4));
    const auto after = clock_reading(answers_from(2010, 1e-4, 1e-4));
    const ClockRate rate = rate_between(*before, *after);
    EXPECT_LT(std::abs(rate.ppm), rate.uncertainty_ppm);
    EXPECT_LT(rate.uncertainty_ppm, 30);
}

// On a busy machine the scanner, or whoever asks, waits for its turn.
TEST(ClockReading, CountsAsUnknownWhatAnswersWaited) {
    for (const auto& [before_s, after_s] : {std::pair{1e-4, 4e-3}, {4e-3, 1e-4}}) {
        const auto before = clock_reading(answers_from(2000, 1e-4, 1e-4));
        const auto after = clock_reading(answers_from(2001, before_s, after_s));
        const ClockRate rate = rate_between(*before, *after);
        EXPECT_GT(std::abs(rate.ppm), 1500);
        EXPECT_LT(std::abs(rate.ppm), rate.uncertainty_ppm);
        EXPECT_LT(rate.uncertainty_ppm, 3000);
    }
}

TEST(ClockReading, IsNoneOfFewAnswers) {
    const auto answers = answers_from(2000, 1e-4, 1e-4);
    EXPECT_FALSE(clock_reading({}));
    EXPECT_FALSE(clock_reading(std::span(answers).first(3)));
    EXPECT_TRUE(clock_reading(std::span(answers).first(4)));
}

TEST(StampStatistics, SayNothingOfWhatIsNotThere) {
    const std::vector<ScanTime> none(100);
    const StampStatistics statistics = stamp_statistics(none, 1e-3);
    EXPECT_FALSE(statistics.rate_hz);
    EXPECT_FALSE(statistics.clock);
    EXPECT_FALSE(stamp_statistics({}, 1e-3).rate_hz);
}

}  // namespace
}  // namespace scipd::tools
