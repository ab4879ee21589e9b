// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The errors that follow from the light that comes back: histograms of many readings against closed
// forms. Seeds are fixed. Bounds are five standard errors where a mean or a deviation is compared:
// a correct model fails one comparison in two million.
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "sim/sensor/echo_model.h"
#include "sim/sensor/error_model.h"
#include "sim/sensor/scanner.h"
#include "sim/sensor/unit_bias.h"

namespace scipd::sim {
namespace {

constexpr int beams = 1000;

SensorSpec scanner() {
    return {.steps_per_turn = 1440,
            .first_step = 0,
            .last_step = beams - 1,
            .front_step = 540,
            .max_range_m = 60.0,
            .noise_law = {.floor_m = 0.010, .weak = 900.0},
            .bias = {{1.0, -0.004}, {5.0, 0.012}, {20.0, 0.002}},
            .receiver = {.dark_range_m = 12.0,
                         .walk_m = 0.01,
                         .intensity = {{0.5, 3000.0}, {5.0, 2000.0}, {20.0, 600.0}},
                         .most_intensity = 1e9}};
}

/// All rays of all beams meet this material at this range and incidence.
struct Wall {
    float range_m;
    float cos_incidence;
    Surface surface;
};

Scan seen(const SensorSpec& spec, const Wall& wall, std::int64_t revolution = 0,
          const ErrorModel& errors = {.accuracy = Accuracy::material, .seed = 11, .sensor = 5}) {
    const BeamPattern pattern(spec);
    Scan scan{.revolution = revolution, .world_from_sensor = {Pose{}}};
    scan.rays_per_beam = pattern.rays_per_beam();
    scan.hits.assign(pattern.directions().size(), {wall.range_m, wall.cos_incidence, 0, 0});
    const LitWorld lit(std::array{wall.surface}, {});
    find_echoes(scan, spec, pattern, lit, errors.key());
    errors.read(spec, Conditions{}.on_for, scan);
    return scan;
}

struct Errors {
    double mean = 0.0;
    double deviation = 0.0;
    double count = 0.0;
};

Errors errors_of(const SensorSpec& spec, const Wall& wall, int scans) {
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    for (int revolution = 0; revolution < scans; ++revolution) {
        for (const Reading& reading : seen(spec, wall, revolution).readings) {
            if (reading.cause != Cause::measured) continue;
            const double error_m = double{reading.range_m} - double{wall.range_m};
            sum += error_m;
            squares += error_m * error_m;
            ++count;
        }
    }
    const double mean = sum / count;
    return {mean, std::sqrt(squares / count - mean * mean), count};
}

const std::vector<Surface> ten_materials = {
    {.diffuse = 0.9F},
    {.diffuse = 0.8F, .roughness = 0.4F},
    {.diffuse = 0.6F, .specular = 0.1F, .gloss = 10.0F},
    {.diffuse = 0.5F},
    {.diffuse = 0.4F, .specular = 0.3F, .gloss = 100.0F},
    {.diffuse = 0.3F, .roughness = 0.8F},
    {.diffuse = 0.2F},
    {.diffuse = 0.1F},
    {.diffuse = 0.3F, .retro = 0.1F},
    {.diffuse = 0.3F, .transmission = 0.5F},
};

// The curve: sigma = floor sqrt(1 + (weak / intensity)²), but no more than that of a dark face at
// the range where it is last seen; bias = b(r) - walk log10(power), of a white face's power at the
// most, with the power of the closed form and 1/r² beyond half a metre.
TEST(LightErrors, FollowTheirCurvesAtTenRangesFiveIncidencesAndTenMaterials) {
    const SensorSpec spec = scanner();
    const double weakest = 0.1 / (12.0 * 12.0);
    int compared = 0;
    for (const float range_m : {0.3F, 0.6F, 1.0F, 2.0F, 3.0F, 4.0F, 6.0F, 8.0F, 10.5F, 15.0F}) {
        for (const double degrees : {0.0, 20.0, 40.0, 60.0, 75.0}) {
            for (const Surface& surface : ten_materials) {
                const double cosine = std::cos(degrees * 3.14159265358979 / 180.0);
                const double power = returned_share(surface, cosine);
                const double signal = power / std::pow(std::max(0.5, double{range_m}), 2);
                if (signal < 1.5 * weakest) continue;  // some would not be noticed
                const double told =
                    std::max(spec.intensity(range_m, power), spec.intensity(12.0, 0.1));
                const double sigma = 0.010 * std::hypot(1.0, 900.0 / told);
                const double bias = spec.bias_m(range_m) - 0.01 * std::log10(std::min(power, 1.0));
                const Errors errors =
                    errors_of(spec, {range_m, static_cast<float>(cosine), surface}, 2);
                ASSERT_EQ(errors.count, 2.0 * beams);
                const double root = std::sqrt(errors.count);
                // The table of powers is right to 0.2 %, which is 10 um of walk.
                ASSERT_NEAR(errors.mean, bias, 5 * sigma / root + 2e-5)
                    << range_m << " m " << degrees << " deg " << surface.diffuse;
                ASSERT_NEAR(errors.deviation, sigma, 5 * sigma / root / std::sqrt(2.0))
                    << range_m << " m " << degrees << " deg " << surface.diffuse;
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 350);
}

// Chi-square of 20 000 errors in 20 bins of equal probability: 19 degrees of freedom, 43.8 at a
// level of one in a thousand.
TEST(LightErrors, AreNormallyDistributed) {
    const SensorSpec spec = scanner();
    const Wall wall{3.0F, 1.0F, {.diffuse = 0.9F}};
    const double power = 0.9;
    const double bias = spec.bias_m(3.0) - 0.01 * std::log10(power);
    const double sigma = 0.010 * std::hypot(1.0, 900.0 / spec.intensity(3.0, power));
    std::array<int, 20> bins{};
    for (int revolution = 0; revolution < 20; ++revolution) {
        for (const Reading& reading : seen(spec, wall, revolution).readings) {
            const double z = (double{reading.range_m} - 3.0 - bias) / sigma;
            const double share = 0.5 * std::erfc(-z / std::sqrt(2.0));
            ++bins[std::min<std::size_t>(19, static_cast<std::size_t>(20.0 * share))];
        }
    }
    double chi_square = 0.0;
    for (const int count : bins)
        chi_square += (count - 1000.0) * (count - 1000.0) / 1000.0;
    EXPECT_LT(chi_square, 43.8);
}

double correlation_of(const std::vector<double>& a, const std::vector<double>& b) {
    double ab = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += a[i] * b[i];
        aa += a[i] * a[i];
        bb += b[i] * b[i];
    }
    return ab / std::sqrt(aa * bb);
}

TEST(LightErrors, AreIndependentBetweenBeamsAndScans) {
    const SensorSpec spec = scanner();
    const Wall wall{3.0F, 1.0F, {.diffuse = 0.9F}};
    const double mean = 3.0 + spec.bias_m(3.0) - 0.01 * std::log10(0.9);
    std::vector<double> all;
    for (int revolution = 0; revolution < 20; ++revolution) {
        for (const Reading& reading : seen(spec, wall, revolution).readings)
            all.push_back(reading.range_m - mean);
    }
    for (const std::size_t apart : {std::size_t{1}, std::size_t{2}, std::size_t{beams}}) {
        const std::vector<double> from(all.begin(), all.end() - static_cast<std::ptrdiff_t>(apart));
        const std::vector<double> to(all.begin() + static_cast<std::ptrdiff_t>(apart), all.end());
        EXPECT_LT(std::abs(correlation_of(from, to)), 5.0 / std::sqrt(double(from.size())))
            << apart;
    }
}

double noticed_share(const SensorSpec& spec, const Wall& wall) {
    double noticed = 0.0;
    for (int revolution = 0; revolution < 10; ++revolution) {
        for (const Reading& reading : seen(spec, wall, revolution).readings)
            noticed += reading.cause == Cause::measured ? 1.0 : 0.0;
    }
    return noticed / (10.0 * beams);
}

// The logarithm of the signal decides, with the deviation noticing_spread.
TEST(LightErrors, HideADarkFaceBehindItsRange) {
    const SensorSpec spec = scanner();
    const Surface dark{.diffuse = 0.1F};
    for (const double times : {0.8, 0.95, 0.98, 1.0, 1.02, 1.05, 1.2}) {
        const auto range_m = static_cast<float>(12.0 * times);
        const double z = -2.0 * std::log(times) / noticing_spread;
        const double share = 0.5 * std::erfc(-z / std::sqrt(2.0));
        EXPECT_NEAR(noticed_share(spec, {range_m, 1.0F, dark}), share,
                    5 * 0.5 / std::sqrt(10.0 * beams))
            << times;
    }
    for (const Reading& reading : seen(spec, {20.0F, 1.0F, dark}).readings)
        ASSERT_EQ(reading.cause, Cause::too_dark);
}

TEST(LightErrors, SayWhyThereIsNoRange) {
    SensorSpec spec = scanner();
    spec.receiver.blinding_signal = 100.0;
    const Surface tape{.diffuse = 0.3F, .retro = 0.25F};
    EXPECT_EQ(seen(spec, {1.0F, 1.0F, tape}).readings[0].cause, Cause::too_bright);
    EXPECT_EQ(seen(spec, {10.0F, 1.0F, tape}).readings[0].cause, Cause::measured);
    spec.lost_share = 0.1;
    const Scan scan = seen(spec, {2.0F, 1.0F, {}});
    const auto lost = std::ranges::count(scan.readings, Cause::lost, &Reading::cause);
    EXPECT_NEAR(double(lost), 0.1 * beams, 5 * std::sqrt(0.1 * 0.9 * beams));
    Scan nothing{.world_from_sensor = {Pose{}}, .hits = std::vector<Hit>(beams)};
    find_echoes(nothing, spec, BeamPattern(spec), LitWorld(std::array{Surface{}}, {}), {});
    ErrorModel{.accuracy = Accuracy::material}.read(spec, Conditions{}.on_for, nothing);
    EXPECT_GT(std::ranges::count(nothing.readings, Cause::nothing, &Reading::cause), beams / 2);
}

TEST(LightErrors, AreMultiplesOfTheLattice) {
    SensorSpec spec = scanner();
    spec.lattice_m = 0.005;
    for (const Reading& reading : seen(spec, {3.0F, 1.0F, {}}).readings) {
        const double multiples = double{reading.range_m} / 0.005;
        ASSERT_NEAR(multiples, std::round(multiples), 1e-3);
    }
}

TEST(LightErrors, StayWithinTheAccuracyUnlessTheBiasDoesNot) {
    SensorSpec spec = scanner();
    spec.accuracy = {{.from_range_m = 0.0, .bound_m = 0.012, .bound_share = 0.0}};
    const Light dark{.power = 0.01, .signal = 0.0025};  // its walk is 20 mm
    EXPECT_DOUBLE_EQ(steady_error_m(spec, 2.0, 0.0, dark), 0.012);
    EXPECT_DOUBLE_EQ(steady_error_m(spec, 2.0, -0.010, dark), 0.010);
    EXPECT_DOUBLE_EQ(steady_error_m(spec, 2.0, 0.050, dark), 0.050);
    EXPECT_DOUBLE_EQ(steady_error_m(spec, 2.0, -0.050, dark), -0.030);
    const Light film{.power = 200.0, .signal = 50.0};
    EXPECT_DOUBLE_EQ(steady_error_m(spec, 2.0, 0.005, film), 0.005);
}

TEST(LightErrors, DriftAwayWhileTheSensorWarmsUp) {
    SensorSpec spec = scanner();
    spec.noise_law = {};
    spec.bias.clear();
    spec.warm_up = {.drift_m = 0.010, .time_constant = std::chrono::minutes(20)};
    const ErrorModel errors{.accuracy = Accuracy::sensor};
    for (const int minutes : {0, 10, 20, 60, 600}) {
        const Reading reading =
            errors.read(spec, std::chrono::minutes(minutes), 0, {2.0F, 1, 0, 0});
        EXPECT_NEAR(reading.range_m, 2.0 + 0.010 * std::exp(-minutes / 20.0), 1e-6) << minutes;
    }
}

/// A beam with two faces behind each other, as two echoes.
Scan two_echoes(float near_power, float far_power, const SensorSpec& spec, ErrorModel errors) {
    Scan scan{.world_from_sensor = {Pose{}}, .hits = std::vector<Hit>(1)};
    scan.echoes.add({2.0F, near_power, 0.0F, 0, 0});
    scan.echoes.add({6.0F, far_power, 0.0F, 1, 0});
    scan.echoes.finish_beam();
    errors.accuracy = Accuracy::material;
    errors.read(spec, Conditions{}.on_for, scan);
    return scan;
}

TEST(LightErrors, TellTheEchoThatTheSensorChooses) {
    SensorSpec spec = scanner();
    spec.noise_law = {};
    spec.bias.clear();
    spec.receiver.walk_m = 0.0;
    // 6 m away the light has fallen to a ninth of that at 2 m.
    for (const auto& [choice, far_power, range_m] : {std::tuple{EchoChoice::first, 5.0F, 2.0F},
                                                     {EchoChoice::last, 0.1F, 6.0F},
                                                     {EchoChoice::strongest, 1.0F, 2.0F},
                                                     {EchoChoice::strongest, 5.0F, 6.0F}}) {
        const Scan scan = two_echoes(0.5F, far_power, spec, {.choice = choice});
        EXPECT_EQ(scan.readings[0].range_m, range_m);
        EXPECT_TRUE(scan.every_echo.empty());
    }
    const Scan both = two_echoes(0.5F, 0.5F, spec, {.tells_every_echo = true});
    ASSERT_EQ(both.every_echo[0].size(), 2U);
    EXPECT_EQ(both.every_echo[0][0].range_m, 2.0F);
    EXPECT_EQ(both.every_echo[0][1].range_m, 6.0F);
}

TEST(LightErrors, GiveUpWherePhasesContradict) {
    SensorSpec spec = scanner();
    spec.receiver.edge_share = 0.3;
    EXPECT_EQ(two_echoes(0.5F, 4.0F, spec, {}).readings[0].cause, Cause::edge);
    EXPECT_EQ(two_echoes(0.5F, 0.5F, spec, {}).readings[0].cause, Cause::measured);
}

}  // namespace
}  // namespace scipd::sim
