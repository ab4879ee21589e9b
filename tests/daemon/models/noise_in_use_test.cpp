// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What two usual programs make of the noise: a filter that takes away shadow points, and a wall
// that people touch.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/models/model_registry.h"
#include "tests/daemon/models/cast_by_hand.h"

namespace scipd::daemon {
namespace {

/// A square room of 6 m with the scanner in its middle.
sim::Hit room(double bearing_rad) {
    const double quarter = std::round(bearing_rad / (90.0 * degree));
    const double met_rad = bearing_rad - quarter * 90.0 * degree;
    const auto wall = static_cast<sim::ObjectId>(quarter + 2.0);
    return {static_cast<float>(3.0 / std::cos(met_rad)), static_cast<float>(std::cos(met_rad)),
            wall, 0};
}

/// A hand of 80 mm at 2 m, with the next wall 1 m behind it.
constexpr double hand_m = 2.0;
constexpr double half_hand_m = 0.04;
sim::Hit hand_on_a_wall(double bearing_rad) {
    const bool met = std::abs(hand_m * std::tan(bearing_rad)) < half_hand_m;
    const double away_m = met ? hand_m : 3.0;
    return {static_cast<float>(away_m / std::cos(bearing_rad)),
            static_cast<float>(std::cos(bearing_rad)), met ? 1U : 0U, 0};
}

std::vector<double> ranges_m(const sim::Scan& scan) {
    std::vector<double> ranges;
    for (const sim::Reading& reading : scan.readings)
        ranges.push_back(double{reading.range_m});
    return ranges;
}

/// How many readings the ScanShadowsFilter of laser_filters deletes with the parameters of its
/// documentation: where the line through two neighbours lies within 10 degrees of the beam, those
/// of the 20 beams on either side that are farther than the nearer one go.
std::size_t shadows(const std::vector<double>& range_m, double beam_rad) {
    constexpr std::ptrdiff_t neighbours = 20;
    const auto beams = static_cast<std::ptrdiff_t>(range_m.size());
    std::set<std::ptrdiff_t> deleted;
    for (std::ptrdiff_t i = 0; i < beams; ++i) {
        for (const std::ptrdiff_t j : std::array{i - 1, i + 1}) {
            if (j < 0 || j >= beams) continue;
            const double aside_m = range_m[j] * std::sin(beam_rad);
            const double ahead_m = range_m[i] - range_m[j] * std::cos(beam_rad);
            const double angle_rad = std::atan2(aside_m, ahead_m);
            if (angle_rad > 10.0 * degree && angle_rad < 170.0 * degree) continue;
            const std::ptrdiff_t end = std::min(i + neighbours, beams - 1);
            for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(i - neighbours, 0); k <= end; ++k) {
                if (range_m[i] < range_m[k]) deleted.insert(k);
            }
        }
    }
    return deleted.size();
}

TEST(ShadowFilter, LeavesARoomAlone) {
    for (const char* name : {"UST-10LX", "UTM-30LX", "URG-04LX", "UHG-08LX", "UXM-30LX-E"}) {
        const sim::SensorSpec& optics = find_model(name).optics;
        const int aside = std::min(optics.front_step - optics.first_step, 500);
        for (int revolution = 0; revolution < 20; ++revolution) {
            const auto readings_m = ranges_m(scan_of(room, optics, revolution, {.aside = aside}));
            EXPECT_LE(shadows(readings_m, optics.beam_rad()), readings_m.size() / 10) << name;
        }
    }
}

// With the accuracy of a data sheet for noise the filter deletes most of that room.
TEST(ShadowFilter, FindsTheNoiseOfADataSheet) {
    sim::SensorSpec optics = find_model("UST-10LX").optics;
    optics.noise = {{0.0, 0.030, 0.0}};
    optics.smoothing = {};
    const auto readings_m = ranges_m(scan_of(room, optics, 0, {.aside = 500}));
    EXPECT_GT(shadows(readings_m, optics.beam_rad()), readings_m.size() * 6 / 10);
}

TEST(Hand, IsFoundWithinThreeMillimetres) {
    for (const char* name : {"UST-10LX", "UTM-30LX", "URG-04LX"}) {
        const sim::SensorSpec& optics = find_model(name).optics;
        constexpr int scans = 500;
        double sum_m = 0.0;
        double squares_m2 = 0.0;
        for (int revolution = 0; revolution < scans; ++revolution) {
            double centre_m = 0.0;
            int beams = 0;
            for (const double range_m : ranges_m(scan_of(hand_on_a_wall, optics, revolution))) {
                if (range_m > hand_m + 0.5) continue;
                centre_m += range_m;
                ++beams;
            }
            centre_m /= beams;
            sum_m += centre_m;
            squares_m2 += centre_m * centre_m;
        }
        const double mean_m = sum_m / scans;
        EXPECT_LT(std::sqrt(squares_m2 / scans - mean_m * mean_m), 0.003) << name;
        EXPECT_NEAR(mean_m, hand_m, 0.003) << name;
    }
}

}  // namespace
}  // namespace scipd::daemon
