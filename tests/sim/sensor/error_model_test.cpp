// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/error_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "sim/sensor/scanner.h"

namespace scipd::sim {
namespace {

constexpr float nothing = std::numeric_limits<float>::infinity();

SensorSpec noisy_spec() {
    SensorSpec spec{.steps_per_turn = 1440, .first_step = 0, .last_step = 1080, .front_step = 540};
    spec.noise = {{0.0, 0.010, 0.0}, {10.0, 0.0, 0.01}};
    return spec;
}

std::vector<Hit> wall_at(float range_m, std::size_t beams = 1081) {
    return std::vector<Hit>(beams, Hit{range_m, 1.0F, 0, 0});
}

std::vector<float> read(const ErrorModel& errors, std::int64_t revolution,
                        const std::vector<Hit>& hits) {
    Scan scan{.revolution = revolution, .hits = hits};
    errors.read(noisy_spec(), Conditions{}.on_for, scan);
    std::vector<float> range_m(hits.size(), -1.0F);
    std::ranges::transform(scan.readings, range_m.begin(), &Reading::range_m);
    return range_m;
}

struct Moments {
    double mean;
    double deviation;
};

/// Moments of the error of many scans of a wall.
Moments error_at(float wall_m, int scans) {
    const ErrorModel errors{Accuracy::sensor, 42, 7};
    double sum = 0.0;
    double squares = 0.0;
    const std::vector<Hit> hits = wall_at(wall_m);
    for (int scan = 0; scan < scans; ++scan) {
        for (const float range_m : read(errors, scan, hits)) {
            const double error_m = double{range_m} - double{wall_m};
            sum += error_m;
            squares += error_m * error_m;
        }
    }
    const double draws = 1081.0 * scans;
    return {sum / draws, std::sqrt(squares / draws)};
}

TEST(ErrorModel, ReadsTheTruthWhenIdeal) {
    const ErrorModel errors{Accuracy::ideal, 42, 7};
    EXPECT_EQ(read(errors, 3, wall_at(4.321F)), std::vector<float>(1081, 4.321F));
}

TEST(ErrorModel, HasTheSpecsDeviationAndNoBias) {
    constexpr int scans = 100;
    const double draws = 1081.0 * scans;
    for (const auto& [wall_m, sigma_m] : {std::pair{5.0F, 0.010}, {20.0F, 0.200}}) {
        const Moments error = error_at(wall_m, scans);
        EXPECT_NEAR(error.mean, 0.0, 5 * sigma_m / std::sqrt(draws)) << wall_m;
        EXPECT_NEAR(error.deviation, sigma_m, 5 * sigma_m / std::sqrt(2 * draws)) << wall_m;
    }
}

TEST(ErrorModel, IsAFunctionOfSeedSensorScanAndBeam) {
    const std::vector<Hit> hits = wall_at(5.0F);
    const std::vector<float> one = read({Accuracy::sensor, 42, 7}, 3, hits);
    EXPECT_EQ(read({Accuracy::sensor, 42, 7}, 3, hits), one);
    EXPECT_NE(read({Accuracy::sensor, 43, 7}, 3, hits), one);
    EXPECT_NE(read({Accuracy::sensor, 42, 8}, 3, hits), one);
    EXPECT_NE(read({Accuracy::sensor, 42, 7}, 4, hits), one);
    EXPECT_NE(one[0], one[1]);
}

// The draw of a beam must not depend on what the other beams met.
TEST(ErrorModel, GivesABeamTheSameNoiseWhateverTheOthersSee) {
    std::vector<Hit> hits = wall_at(5.0F);
    const std::vector<float> all = read({Accuracy::sensor, 42, 7}, 3, hits);
    std::fill(hits.begin(), hits.begin() + 500, Hit{});
    const std::vector<float> some = read({Accuracy::sensor, 42, 7}, 3, hits);
    EXPECT_EQ(std::vector(some.begin() + 500, some.end()),
              std::vector(all.begin() + 500, all.end()));
}

TEST(ErrorModel, LeavesNothingAtNothing) {
    const ErrorModel errors{Accuracy::sensor, 42, 7};
    EXPECT_EQ(read(errors, 3, std::vector<Hit>(100)), std::vector<float>(100, nothing));
}

TEST(ErrorModel, NeverReadsBelowZero) {
    const std::vector<float> range_m = read({Accuracy::sensor, 42, 7}, 3, wall_at(0.001F));
    EXPECT_GE(std::ranges::min(range_m), 0.0F);
    EXPECT_EQ(std::ranges::count(range_m, 0.0F) > 100, true);  // many would have been negative
}

}  // namespace
}  // namespace scipd::sim
