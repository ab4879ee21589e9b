// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Echoes of footprints that are cast for real, against geometry and the laws of optics.
#include "sim/sensor/echo_model.h"

#include <algorithm>
#include <cmath>

#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "tests/sim/sensor/lit_scan.h"

namespace scipd::sim {
namespace {

const Surface grey{.diffuse = 0.25F};

class Echoes : public testing::TestWithParam<const char*> {
  protected:
    [[nodiscard]] SharedScan scan(const SharedScene& scene, const std::vector<Surface>& surfaces,
                                  const SensorSpec& spec = small_scanner(0.01),
                                  const std::vector<Medium>& media = {}) const {
        return lit_scan(GetParam(), scene, surfaces, spec, media);
    }
};

/// A wall of 20 m by 20 m across x.
SharedScene wall_at(double x_m) {
    return SceneBuilder().add(Box{{0.2, 20.0, 20.0}}, ahead(x_m + 0.1), 1).build();
}

TEST_P(Echoes, OfAWallAreLamberts) {
    for (const float reflectance : {0.1F, 0.5F, 0.9F}) {
        const auto seen =
            scan(wall_at(5.0), {white, {.diffuse = reflectance}}, small_scanner(0.0005));
        for (std::size_t beam = 0; beam < seen->beams(); ++beam) {
            const double angle_rad = glm::radians(double(beam) - front_beam);
            ASSERT_EQ(seen->echoes[beam].size(), 1U);
            const Echo& echo = seen->echoes[beam].front();
            EXPECT_NEAR(echo.range_m, 5.0 / std::cos(angle_rad), 1e-3);
            EXPECT_NEAR(echo.power, reflectance * std::cos(angle_rad), 2e-3 * reflectance);
            EXPECT_EQ(echo.material, 1U);
        }
    }
}

// A beam whose light has a deviation of half its half width meets a sloping wall at ranges with a
// deviation of r * sigma * tan(slope).
TEST_P(Echoes, SpreadOnSlopingWalls) {
    for (const double slope_deg : {0.0, 30.0, 60.0}) {
        const Pose turned = pose_from_rpy({5.0, 0.0, 0.0}, {0.0, 0.0, glm::radians(slope_deg)});
        const auto scene = SceneBuilder().add(Box{{0.0001, 40.0, 20.0}}, turned, 1).build();
        const auto seen = scan(scene, {white, white}, small_scanner(0.004));
        const Echo& echo = seen->echoes[front_beam].front();
        EXPECT_NEAR(echo.spread_m, 5.0 * 0.002 * std::tan(glm::radians(slope_deg)), 5e-4)
            << slope_deg;
    }
}

/// Half of the front beam meets a near wall on its left, the other half one that lies `gap_m`
/// behind.
SharedScene step_of(double gap_m) {
    return SceneBuilder()
        .add(Box{{0.2, 10.0, 10.0}}, ahead(4.1, 5.0), 1)
        .add(Box{{0.2, 30.0, 30.0}}, ahead(4.1 + gap_m), 2)
        .build();
}

TEST_P(Echoes, OfAnEdgeAreOneWhereItIsLow) {
    SensorSpec spec = small_scanner(0.02, 13);
    spec.receiver.half_pulse_m = 0.75;
    const auto seen = scan(step_of(0.5), {white, white, grey}, spec);
    ASSERT_EQ(seen->echoes[front_beam].size(), 1U);
    const Echo& mixed = seen->echoes[front_beam].front();
    EXPECT_GT(mixed.range_m, 4.02F);
    EXPECT_LT(mixed.range_m, 4.48F);
    EXPECT_GT(mixed.spread_m, 0.1F);
    EXPECT_EQ(mixed.material, 1U);  // the brighter one
    // Away from the edge nothing is mixed.
    for (const std::size_t beam : {front_beam - 5, front_beam + 5}) {
        ASSERT_EQ(seen->echoes[beam].size(), 1U);
        EXPECT_LT(seen->echoes[beam].front().spread_m, 0.02F);
    }
}

// The mean of what both sides send, each by its share of the light.
TEST_P(Echoes, OfALowEdgeLieWhereTheirLightSays) {
    SensorSpec spec = small_scanner(0.02, 7);
    const auto seen = scan(step_of(0.4), {white, white, grey}, spec);
    // Three rays of the ring lie to the left, three to the right or on the edge with the middle.
    double near = 0.0;
    double far = 0.0;
    const auto rays = footprint_rays(7);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Hit& hit = seen->hits[front_beam * 7 + i];
        (hit.material == 1 ? near : far) += rays[i].weight * (hit.material == 1 ? 1.0 : 0.25);
    }
    ASSERT_GT(near, 0.0);
    ASSERT_GT(far, 0.0);
    const double expected_m = (near * 4.0 + far * 4.4) / (near + far);
    EXPECT_NEAR(seen->echoes[front_beam].front().range_m, expected_m, 2e-3);
}

TEST_P(Echoes, OfAHighEdgeAreTwo) {
    SensorSpec spec = small_scanner(0.02, 13);
    const auto seen = scan(step_of(2.0), {white, white, white}, spec);
    const auto echoes = seen->echoes[front_beam];
    ASSERT_EQ(echoes.size(), 2U);
    EXPECT_NEAR(echoes[0].range_m, 4.0, 2e-3);
    EXPECT_NEAR(echoes[1].range_m, 6.0, 2e-3);
    EXPECT_NEAR(echoes[0].power + echoes[1].power, 1.0, 1e-2);
    EXPECT_EQ(echoes[0].material, 1U);
    EXPECT_EQ(echoes[1].material, 2U);
}

TEST_P(Echoes, FadeInFogAsBeerAndLambertSay) {
    const Medium haze{.name = "haze", .extinction_per_m = 0.05};
    for (const double wall_m : {1.0, 5.0, 15.0}) {
        const auto clear = scan(wall_at(wall_m), {white, white});
        const auto hazy = scan(wall_at(wall_m), {white, white}, small_scanner(0.01), {haze});
        const double left =
            hazy->echoes[front_beam].front().power / clear->echoes[front_beam].front().power;
        EXPECT_NEAR(left, std::exp(-2.0 * 0.05 * wall_m), 1e-3) << wall_m;
    }
}

// exp(-2 * 3 * 50) is less than the smallest float.
TEST_P(Echoes, AreNoneOfFacesThatFogHidesAltogether) {
    const Medium thick{.name = "thick", .extinction_per_m = 3.0};
    const auto seen = scan(wall_at(50.0), {white, white}, small_scanner(0.001), {thick});
    EXPECT_TRUE(seen->middle(front_beam).met());
    EXPECT_TRUE(seen->echoes[front_beam].empty());
    EXPECT_EQ(seen->readings[front_beam].cause, Cause::nothing);
}

TEST_P(Echoes, FadeOnlyWithinTheBoxOfAMedium) {
    const Medium cloud{.name = "cloud",
                       .low_m = {2.0, -0.5, -0.5},
                       .high_m = {3.5, 0.5, 0.5},
                       .extinction_per_m = 0.4};
    const auto seen = scan(wall_at(5.0), {white, white}, small_scanner(0.001), {cloud});
    EXPECT_NEAR(seen->echoes[front_beam].front().power, std::exp(-2.0 * 0.4 * 1.5), 1e-3);
    const double beside_rad = glm::radians(20.0);  // passes the box
    EXPECT_NEAR(seen->echoes[front_beam + 20].front().power, std::cos(beside_rad), 1e-3);
}

// The way to the first drop is exponentially distributed: a Kolmogorov-Smirnov test over all beams
// of many scans, at a level of one in a thousand, with a fixed seed.
TEST_P(Echoes, OfDropsComeFromExponentialRanges) {
    const Medium drizzle{.name = "drizzle", .returns_per_m = 0.5, .brightness = 0.1};
    const auto nothing = SceneBuilder().build();
    std::vector<double> ranges_m;
    for (std::int64_t revolution = 0; revolution < 100; ++revolution) {
        const auto seen =
            lit_scan(GetParam(), nothing, {white}, small_scanner(0.01), {drizzle}, revolution);
        for (const Echo& echo : seen->echoes.all())
            ranges_m.push_back(echo.range_m);
    }
    ASSERT_EQ(ranges_m.size(), 4100U);  // all but never is one farther than 60 m
    std::ranges::sort(ranges_m);
    double worst = 0.0;
    for (std::size_t i = 0; i < ranges_m.size(); ++i) {
        const double expected = 1.0 - std::exp(-0.5 * ranges_m[i]);
        worst = std::max(worst, std::abs(expected - double(i) / double(ranges_m.size())));
    }
    EXPECT_LT(worst, 1.95 / std::sqrt(double(ranges_m.size())));
}

TEST_P(Echoes, GetAShareOfTheirNeighboursLight) {
    SensorSpec spec = small_scanner(0.0, 1);
    spec.receiver.half_pulse_m = 10.0;
    const auto alone = scan(step_of(0.5), {white, grey, white}, spec);
    spec.receiver.crosstalk = 0.1;
    const auto mixed = scan(step_of(0.5), {white, grey, white}, spec);
    for (std::size_t beam = 1; beam + 1 < alone->beams(); ++beam) {
        double power = 0.0;
        double sum_m = 0.0;
        for (const auto& [from, share] : {std::pair{beam - 1, 0.1}, {beam, 1.0}, {beam + 1, 0.1}}) {
            const Echo& echo = alone->echoes[from].front();
            power += share * echo.power;
            sum_m += share * double{echo.power} * echo.range_m;
        }
        EXPECT_NEAR(mixed->echoes[beam].front().range_m, sum_m / power, 1e-4) << beam;
        EXPECT_NEAR(mixed->echoes[beam].front().power, power, 1e-4) << beam;
    }
}

TEST_P(Echoes, VaryOverATextureAsItSays) {
    const Surface mottled{.diffuse = 0.5F, .texture = 0.2F};
    const auto one = scan(wall_at(5.0), {white, mottled}, small_scanner(0.0, 1));
    const auto again = scan(wall_at(5.0), {white, mottled}, small_scanner(0.0, 1));
    double sum = 0.0;
    double squares = 0.0;
    const auto count = double(one->beams());
    for (std::size_t beam = 0; beam < one->beams(); ++beam) {
        EXPECT_EQ(one->echoes[beam].front().power, again->echoes[beam].front().power);
        const double cosine = one->middle(beam).cos_incidence;
        const double factor = one->echoes[beam].front().power / (0.5 * cosine);
        sum += factor;
        squares += factor * factor;
    }
    const double mean = sum / count;
    const double deviation = std::sqrt(squares / count - mean * mean);
    EXPECT_NEAR(mean, 1.0, 5 * 0.2 / std::sqrt(count));
    EXPECT_NEAR(deviation, 0.2, 5 * 0.2 / std::sqrt(2 * count));
}

// The face lies at a round number, so rounding differs from backend to backend and from place to
// place.
TEST(Textures, AreTheSameForAllBackendsAlsoBehindGlass) {
    const Surface mottled{.diffuse = 0.5F, .texture = 0.5F};
    const Surface clear{.diffuse = 0.0F, .transmission = 0.95F};
    const auto scene = SceneBuilder()
                           .add(Box{{0.004, 0.6, 20.0}}, ahead(1.002), 2)
                           .add(Box{{0.2, 40.0, 20.0}}, ahead(3.1), 1)
                           .build();
    const std::vector<Surface> surfaces{white, mottled, clear};
    const auto one = lit_scan("embree", scene, surfaces, small_scanner(0.0, 1));
    const auto other = lit_scan("reference", scene, surfaces, small_scanner(0.0, 1));
    double squares = 0.0;
    int behind_glass = 0;
    for (std::size_t beam = 0; beam < one->beams(); ++beam) {
        ASSERT_EQ(one->echoes[beam].size(), other->echoes[beam].size());
        if (one->echoes[beam].empty()) continue;  // the texture may be black there
        const Echo& echo = one->echoes[beam].back();
        EXPECT_NEAR(echo.power, other->echoes[beam].back().power, 1e-3 * echo.power) << beam;
        if (one->middle(beam).material != 2) continue;
        const double plain = 0.5 * std::pow(0.95, 4) * echo.range_m / 3.0;
        squares += std::pow(echo.power / plain - 1.0, 2);
        ++behind_glass;
    }
    EXPECT_GT(behind_glass, 20);
    EXPECT_GT(std::sqrt(squares / behind_glass), 0.2);
}

INSTANTIATE_TEST_SUITE_P(Through, Echoes, testing::Values("embree", "reference"),
                         [](const auto& backend) { return std::string(backend.param); });

}  // namespace
}  // namespace scipd::sim
