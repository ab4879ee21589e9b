// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Cameras and rangers before walls and poles, by every backend, against closed form.
#include "sim/sensor/staring.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/sim/backends/contract.h"
#include "tests/support/scene_builder.h"

namespace scipd::sim {
namespace {

using namespace std::chrono_literals;

constexpr double degree = std::numbers::pi / 180;

StaringSpec camera(int columns = 88, int rows = 72) {
    return {.optics = PinholeGrid{columns, rows, 43.6 * degree, 34.6 * degree},
            .period = 40ms,
            .min_range_m = 0.1,
            .max_range_m = 7.5};
}

StaringSpec ranger(double opening_deg, int beams, Aggregate aggregate) {
    return {.optics = RangerOptics{{opening_deg * degree, beams}, aggregate},
            .period = 50ms,
            .min_range_m = 0.02,
            .max_range_m = 7.0};
}

/// A thick wall whose face is so far from the origin along its normal, which is turned to the left.
SceneBuilder wall(double distance_m, double turned_rad = 0.0) {
    const glm::dvec3 normal{std::cos(turned_rad), std::sin(turned_rad), 0.0};
    Pose pose = pose_from_rpy({0, 0, 0}, {0, 0, turned_rad});
    pose.translation_m = normal * (distance_m + 0.5);
    return SceneBuilder().add(Box{{1, 40, 40}}, pose);
}

std::vector<float> read(RangeBackend& backend, const StaringSpec& spec,
                        const ErrorModel& errors = {.accuracy = Accuracy::ideal},
                        std::int64_t number = 0) {
    const Staring sensor(spec, errors);
    return sensor.read(*sensor.make_scanner().measure(backend, number, 0s, {Pose{}}));
}

class StaringTest : public testing::TestWithParam<std::string> {
  protected:
    void SetUp() override {
        if (const auto why = what_lacks(GetParam()); !why.empty()) GTEST_SKIP() << why;
    }

    static std::vector<float> read_in(const SceneBuilder& scene, const StaringSpec& spec,
                                      const ErrorModel& errors = {.accuracy = Accuracy::ideal}) {
        return read(*make_backend(GetParam(), scene.build()), spec, errors);
    }
    static float told_in(const SceneBuilder& scene, const StaringSpec& spec) {
        const auto ranges = read_in(scene, spec);
        EXPECT_EQ(ranges.size(), 1U);
        return ranges.front();
    }
};

INSTANTIATE_TEST_SUITE_P(All, StaringTest, testing::ValuesIn(backend_names()),
                         [](const auto& test) { return test.param; });

TEST_P(StaringTest, ACameraSeesAWallAlongItsRays) {
    const auto range_m = read_in(wall(4.0), camera());
    ASSERT_EQ(range_m.size(), 88U * 72U);
    for (int row = 0; row < 72; ++row) {
        for (int column = 0; column < 88; ++column) {
            const double y = std::tan(21.8 * degree) * (43.5 - column) / 44.0;
            const double z = std::tan(17.3 * degree) * (35.5 - row) / 36.0;
            ASSERT_NEAR(range_m[static_cast<std::size_t>(row * 88 + column)],
                        4.0 * std::sqrt(1 + y * y + z * z), range_tolerance_m)
                << row << ", " << column;
        }
    }
}

TEST_P(StaringTest, ACameraHasItsFirstRowOnTopAndItsFirstColumnOnTheLeft) {
    const auto range_m = read_in(
        wall(4.0).add(Box{{0.2, 0.6, 0.5}}, pose_from_rpy({3.0, 0.9, 0.7}, {0, 0, 0})), camera());
    EXPECT_LT(range_m[5U * 88U + 8U], 3.5F);
    EXPECT_GT(range_m[5U * 88U + 79U], 3.9F);
    EXPECT_GT(range_m[66U * 88U + 8U], 3.9F);
}

TEST_P(StaringTest, NothingIsWhatLiesOutOfRange) {
    for (const float range_m : read_in(wall(7.6), camera()))
        ASSERT_EQ(range_m, nothing);
    for (const float range_m : read_in(wall(0.05), camera()))
        ASSERT_EQ(range_m, nothing);
    // Where 7.4 m / cos reaches 7.5 m.
    const auto range_m = read_in(wall(7.4), camera());
    const auto seen = std::ranges::count_if(range_m, [](float range) { return range < 7.5F; });
    const double within = std::sqrt(7.5 * 7.5 / (7.4 * 7.4) - 1.0);
    const double pixel_area = 4 * std::tan(21.8 * degree) * std::tan(17.3 * degree) / (88 * 72);
    EXPECT_NEAR(double(seen), std::numbers::pi * within * within / pixel_area, 40.0);
    EXPECT_EQ(std::ranges::count(range_m, nothing) + seen, 88 * 72);
}

// The foot of the perpendicular is seen, or the rim comes nearest to it.
TEST_P(StaringTest, ARangerTellsTheNearestOfAnObliqueWall) {
    for (const double turned_deg : {0.0, 10.0, 40.0}) {
        const glm::vec3 normal(std::cos(turned_deg * degree), std::sin(turned_deg * degree), 0);
        double nearest_m = 1e9;
        for (const glm::vec3& u : BeamCone{30 * degree, 61}.directions())
            nearest_m = std::min(nearest_m, 2.0 / double{glm::dot(normal, u)});
        const float told_m =
            told_in(wall(2.0, turned_deg * degree), ranger(30, 61, Aggregate::nearest));
        EXPECT_NEAR(told_m, nearest_m, range_tolerance_m) << turned_deg;
        const double missed_rad = std::max(0.0, turned_deg - 15) * degree;
        EXPECT_GE(told_m, 2.0 / std::cos(missed_rad) - range_tolerance_m) << turned_deg;
        // Beams are 3.4 degrees apart.
        EXPECT_LE(told_m, 2.0 / std::cos(missed_rad + 3.4 * degree)) << turned_deg;
    }
}

SceneBuilder pole_before_wall(double pole_m, double bearing_deg, double radius_m) {
    const double x_m = pole_m * std::cos(bearing_deg * degree);
    const double y_m = pole_m * std::sin(bearing_deg * degree);
    return wall(4.0).add(Cylinder{radius_m, 4.0}, pose_from_rpy({x_m, y_m, 0}, {0, 0, 0}));
}

TEST_P(StaringTest, APoleOnTheAxisIsWhatARangerTells) {
    for (const Aggregate aggregate : {Aggregate::nearest, Aggregate::weighted}) {
        const float told_m = told_in(pole_before_wall(2.0, 0, 0.1), ranger(30, 61, aggregate));
        EXPECT_GE(told_m, 1.9 - range_tolerance_m);
        EXPECT_LE(told_m, 1.91);
    }
}

TEST_P(StaringTest, AThinPoleAtTheRimIsToldAsNearestOnly) {
    const SceneBuilder scene = pole_before_wall(2.0, 13, 0.02);
    EXPECT_NEAR(told_in(scene, ranger(30, 1001, Aggregate::nearest)), 1.98, 0.01);
    const float weighted_m = told_in(scene, ranger(30, 1001, Aggregate::weighted));
    EXPECT_GE(weighted_m, 4.0 - range_tolerance_m);
    EXPECT_LE(weighted_m, 4.0 / std::cos(15 * degree));
}

// Beams of a cone lie far apart, and what is between them must not be lost on the way.
TEST_P(StaringTest, EveryBeamOfAConeMeetsWhatTheOracleMeets) {
    const SharedScene scene = pole_before_wall(2.0, 0, 0.1).build();
    const auto backend = make_backend(GetParam(), scene);
    const auto oracle = make_backend("reference", scene);
    for (const double opening_deg : {10.0, 30.0, 60.0}) {
        for (const int beams : {61, 200, 1001}) {
            const Staring sensor(ranger(opening_deg, beams, Aggregate::nearest), {});
            const auto scan = sensor.make_scanner().measure(*backend, 0, 0s, {Pose{}});
            const auto truth = sensor.make_scanner().measure(*oracle, 0, 0s, {Pose{}});
            int differ = 0;
            for (std::size_t i = 0; i < scan->hits.size(); ++i) {
                const Hit& hit = scan->hits[i];
                const Hit& true_hit = truth->hits[i];
                differ += hit.object != true_hit.object ? 1 : 0;
                // Where a round thing is seen flat, a facet beside it is a little nearer.
                if (hit.object == true_hit.object && true_hit.cos_incidence > 0.3F) {
                    ASSERT_NEAR(hit.range_m, true_hit.range_m, 3 * range_tolerance_m) << i;
                }
            }
            EXPECT_LE(differ, 1 + beams / 100) << opening_deg << ", " << beams;
        }
    }
}

TEST_P(StaringTest, ARangerOfHalfTheSpaceSeesToItsSides) {
    EXPECT_NEAR(told_in(wall(3.0, 80 * degree), ranger(180, 2000, Aggregate::nearest)), 3.0, 0.01);
}

TEST_P(StaringTest, WhatIsTooNearIsNothing) {
    EXPECT_EQ(told_in(wall(0.01), ranger(30, 61, Aggregate::nearest)), nothing);
    EXPECT_EQ(told_in(SceneBuilder(), ranger(30, 61, Aggregate::weighted)), nothing);
}

/// Its own errors, at 2 m, in units of sigma.
TEST(StaringNoise, OfARangerIsThatOfOneRange) {
    StaringSpec spec = ranger(30, 61, Aggregate::nearest);
    spec.noise = {{0.0, 0.01, 0.005}};
    const auto backend = make_backend("reference", wall(2.0).build());
    constexpr int times = 2000;
    constexpr double sigma_m = 0.02;
    double sum = 0.0;
    double squares = 0.0;
    for (int number = 0; number < times; ++number) {
        const auto range_m = read(*backend, spec, {Accuracy::sensor, 1, 2}, number);
        sum += double{range_m.front()} - 2.0;
        squares += std::pow(double{range_m.front()} - 2.0, 2);
    }
    EXPECT_NEAR(sum / times, 0.0, 5 * sigma_m / std::sqrt(times));
    EXPECT_NEAR(std::sqrt(squares / times), sigma_m, 5 * sigma_m / std::sqrt(2.0 * times));
}

TEST(StaringNoise, OfACameraIsAFunctionOfSeedSensorNumberAndPixel) {
    StaringSpec spec = camera(8, 6);
    spec.noise = {{0.0, 0.01, 0.0}};
    const auto backend = make_backend("reference", wall(2.0).build());
    const auto one = read(*backend, spec, {Accuracy::sensor, 1, 2}, 5);
    EXPECT_EQ(read(*backend, spec, {Accuracy::sensor, 1, 2}, 5), one);
    EXPECT_NE(read(*backend, spec, {Accuracy::sensor, 1, 2}, 6), one);
    EXPECT_NE(read(*backend, spec, {Accuracy::sensor, 2, 2}, 5), one);
    const auto ideal = read(*backend, spec, {Accuracy::ideal, 1, 2}, 5);
    for (std::size_t i = 0; i < ideal.size(); ++i)
        EXPECT_NEAR(one[i], ideal[i], 0.06);
}

}  // namespace
}  // namespace scipd::sim
