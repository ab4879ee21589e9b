// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/sensor_spec.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "sim/sensor/beam_pattern.h"

namespace scipd::sim {
namespace {

constexpr double pi = std::numbers::pi;

/// 1440 steps a turn, 270 degrees of them measured.
SensorSpec wide() {
    return {.steps_per_turn = 1440, .first_step = 0, .last_step = 1080, .front_step = 540};
}

TEST(SensorSpec, CountsBothEnds) {
    EXPECT_EQ(wide().beams(), 1081);
    EXPECT_EQ((SensorSpec{.steps_per_turn = 1024, .first_step = 44, .last_step = 725}.beams()),
              682);
}

TEST(SensorSpec, MeasuresAnglesFromTheFront) {
    EXPECT_EQ(wide().angle_rad(540), 0.0);
    EXPECT_NEAR(wide().angle_rad(900), pi / 2, 1e-15);
    EXPECT_NEAR(wide().angle_rad(0), -0.75 * pi, 1e-15);
    EXPECT_NEAR(wide().angle_rad(1080), 0.75 * pi, 1e-15);
}

TEST(SensorSpec, FindsTheNoiseOfARange) {
    SensorSpec spec = wide();
    spec.noise = {{0.0, 0.010, 0.0}, {10.0, 0.0, 0.01}};
    EXPECT_DOUBLE_EQ(spec.sigma_m(0.0), 0.010);
    EXPECT_DOUBLE_EQ(spec.sigma_m(9.999), 0.010);
    EXPECT_DOUBLE_EQ(spec.sigma_m(10.0), 0.10);
    EXPECT_DOUBLE_EQ(spec.sigma_m(30.0), 0.30);
}

TEST(SensorSpec, AddsTheFixedAndTheProportionalPart) {
    SensorSpec spec = wide();
    spec.noise = {{0.0, 0.01, 0.002}};
    EXPECT_DOUBLE_EQ(spec.sigma_m(5.0), 0.02);
}

TEST(SensorSpec, HasNoNoiseByDefault) {
    EXPECT_EQ(wide().sigma_m(5.0), 0.0);
}

// A beam that meets nothing has an infinite range, of which no curve knows a value.
TEST(SensorSpec, KnowsNoValueOfAnInfiniteRange) {
    constexpr double far_m = std::numeric_limits<double>::infinity();
    SensorSpec spec = wide();
    EXPECT_FALSE(std::isfinite(spec.bias_m(far_m)));
    spec.bias = {{1.0, 0.010}, {10.0, -0.010}};
    spec.noise = {{0.0, 0.010, 0.0}, {10.0, 0.0, 0.01}};
    for (const double range_m : {far_m, -far_m, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_FALSE(std::isfinite(spec.bias_m(range_m))) << range_m;
        EXPECT_FALSE(std::isfinite(spec.sigma_m(range_m))) << range_m;
    }
    EXPECT_EQ(spec.bias_m(std::numeric_limits<double>::max()), -0.010);
}

TEST(BeamPattern, TurnsCounterClockwiseFromTheFirstStep) {
    const BeamPattern pattern(wide());
    ASSERT_EQ(pattern.directions().size(), 1081U);
    const auto expect_direction = [&](std::size_t beam, const glm::vec3& direction) {
        EXPECT_LT(glm::distance(pattern.directions()[beam], direction), 1e-6F) << beam;
    };
    const float half = std::numbers::sqrt2_v<float> / 2.0F;
    expect_direction(0, {-half, -half, 0});  // behind on the right
    expect_direction(180, {0, -1, 0});
    expect_direction(540, {1, 0, 0});
    expect_direction(900, {0, 1, 0});
    expect_direction(1080, {-half, half, 0});
}

TEST(BeamPattern, BeginsWithTheFirstMeasuredStep) {
    const BeamPattern pattern(
        {.steps_per_turn = 4, .first_step = 2, .last_step = 3, .front_step = 1});
    ASSERT_EQ(pattern.directions().size(), 2U);
    EXPECT_LT(glm::distance(pattern.directions()[0], glm::vec3(0, 1, 0)), 1e-6F);
    EXPECT_LT(glm::distance(pattern.directions()[1], glm::vec3(-1, 0, 0)), 1e-6F);
}

}  // namespace
}  // namespace scipd::sim
