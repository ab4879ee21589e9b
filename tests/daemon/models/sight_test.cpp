// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What each model makes of light, against its data sheet and against what others have published.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/models/model_registry.h"
#include "sim/sensor/echo_model.h"
#include "sim/sensor/scanner.h"
#include "sim/sensor/unit_bias.h"
#include "tests/daemon/models/cast_by_hand.h"

namespace scipd::daemon {
namespace {

/// A flat wall in front of every beam of a model: cast by hand, ray by ray.
sim::Scan wall_seen(const sim::SensorSpec& optics, double range_m, double incidence_rad,
                    const sim::Surface& surface, std::int64_t revolution = 0) {
    const sim::ErrorModel errors{.accuracy = sim::Accuracy::material, .seed = 3, .sensor = 9};
    const sim::BeamPattern pattern(optics);
    sim::Scan scan{.revolution = revolution, .world_from_sensor = {sim::Pose{}}};
    scan.rays_per_beam = pattern.rays_per_beam();
    scan.hits.resize(pattern.directions().size());
    for (std::size_t i = 0; i < scan.hits.size(); ++i) {
        // A ray to the side of its beam meets a turned wall farther or nearer.
        const sim::FootprintRay& ray = pattern.footprint()[i % pattern.rays_per_beam()];
        const double aside_rad = ray.across * optics.footprint.half_width_rad;
        const double ray_m =
            range_m * std::cos(incidence_rad) / std::cos(incidence_rad + aside_rad);
        scan.hits[i] = {static_cast<float>(ray_m), static_cast<float>(std::cos(incidence_rad)), 0,
                        0};
    }
    const sim::LitWorld lit(std::array{surface}, {});
    sim::find_echoes(scan, optics, pattern, lit, errors.key(revolution));
    errors.read(optics, sim::Conditions{}.on_for, scan);
    return scan;
}

double share_seen(const Model& model, double range_m, float reflectance) {
    const sim::Scan scan = wall_seen(model.optics, range_m, 0.0, {.diffuse = reflectance});
    const auto seen = std::ranges::count(scan.readings, sim::Cause::measured, &sim::Reading::cause);
    return double(seen) / double(scan.readings.size());
}

struct DarkRange {
    const char* model;
    double white_m;  ///< the range that the data sheet states
    double dark_m;   ///< the same for a target of 10 %
};

// Hokuyo's product pages of the UST series.
constexpr DarkRange data_sheets[] = {
    {"UST-05LX", 5, 2},  {"UST-10LX", 10, 4},     {"UST-10LX-H01", 10, 4}, {"UST-10LX-H02", 10, 4},
    {"UST-20LX", 20, 8}, {"UST-20LX-H01", 20, 8}, {"UST-30LX", 30, 12},
};

TEST(Sight, LosesADarkTargetWhereTheDataSheetSays) {
    for (const auto& [name, white_m, dark_m] : data_sheets) {
        const Model& model = find_model(name);
        EXPECT_EQ(share_seen(model, 0.9 * dark_m, 0.1F), 1.0) << name;
        EXPECT_NEAR(share_seen(model, dark_m, 0.1F), 0.5, 0.1) << name;
        EXPECT_EQ(share_seen(model, 1.15 * dark_m, 0.1F), 0.0) << name;
        EXPECT_EQ(share_seen(model, white_m, 0.9F), 1.0) << name;
    }
}

class Sights : public testing::TestWithParam<Model> {};

// The range of the data sheet, for those models that no dark range is known of: it follows from
// that of the UST, whose dark range is the white one divided by 2.5.
TEST_P(Sights, SeeWhiteFacesAsFarAsTheirDataSheetSays) {
    const Model& model = GetParam();
    EXPECT_GT(model.optics.receiver.dark_range_m, 0.0);
    EXPECT_EQ(share_seen(model, 2.4 * model.optics.receiver.dark_range_m, 0.9F), 1.0);
    EXPECT_EQ(share_seen(model, 3.3 * model.optics.receiver.dark_range_m, 0.9F), 0.0);
}

TEST_P(Sights, HaveCurvesThatCanBeUsed) {
    const sim::SensorSpec& optics = GetParam().optics;
    EXPECT_EQ(optics.footprint.rays, 7);
    EXPECT_GT(optics.footprint.half_width_rad, 0.001);
    EXPECT_LT(optics.footprint.half_width_rad, 0.02);
    EXPECT_GT(optics.intensity(3.0, 1.0), 100.0);
}

// Kneip et al. 2009: the error of one URG-04LX changes with the distance, by some millimetres
// within its accuracy. The data sheets know +-40 mm or less, or 1 to 3 %.
TEST_P(Sights, ErrInEachUnitAsTheDataSheetAllows) {
    const sim::SensorSpec& optics = GetParam().optics;
    EXPECT_FALSE(optics.accuracy.empty());
    for (std::uint64_t unit = 0; unit < 20; ++unit) {
        sim::SensorSpec of_unit = optics;
        of_unit.bias = sim::unit_bias(optics, unit);
        double least_m = 1.0;
        double most_m = -1.0;
        for (double range_m = 0.1; range_m < 8.0; range_m *= 1.05) {
            const double bias_m = of_unit.bias_m(range_m);
            EXPECT_LE(std::abs(bias_m), std::max(0.040, 0.03 * range_m)) << range_m;
            least_m = std::min(least_m, bias_m);
            most_m = std::max(most_m, bias_m);
        }
        EXPECT_GT(most_m - least_m, 0.002) << unit;
    }
}

// Beacons with film of 220 times a white face's light, before a recorded UST that stood between
// them (SkoltechRobotics/Eurobot2018): the brightest step of each.
TEST(UstSight, CallsReflectorsWhatARecordingCallsThem) {
    const sim::SensorSpec& optics = find_model("UST-10LX").optics;
    for (const auto& [range_m, intensity] : {std::pair{0.61, 10004}, {1.43, 7859}, {2.77, 5816}})
        EXPECT_NEAR(optics.intensity(range_m, 220.0), intensity, 0.25 * intensity) << range_m;
}

INSTANTIATE_TEST_SUITE_P(Of, Sights, testing::ValuesIn(models()), [](const auto& model) {
    std::string name = model.param.profile.name + "_" + model.param.profile.release;
    const auto is_no_letter = [](char c) { return std::isalnum(c) == 0; };
    std::ranges::replace_if(name, is_no_letter, '_');
    return name;
});

// Intensities of a recorded UTM-30LX lie between 137 and 16219: those of a dark face aslant and of
// a reflector do too. Its walls at 2 to 3 m have 2704.
TEST(UtmSight, CallsLightWhatARecordingCallsIt) {
    const sim::SensorSpec& optics = find_model("UTM-30LX").optics;
    EXPECT_GT(optics.intensity(3.0, 0.1 * std::cos(50 * degree)), 100.0);
    EXPECT_LE(optics.intensity(1.0, 800.0), 16383.0);
    EXPECT_NEAR(optics.intensity(2.5, 1.0), 2704, 1);
}

// Walls of a recorded UST have 1360 at 0.9 m, 1010 at 3.1 m and 790 at 6.6 m.
TEST(UstSight, CallsLightWhatARecordingCallsIt) {
    const sim::SensorSpec& optics = find_model("UST-10LX").optics;
    EXPECT_NEAR(optics.intensity(0.9, 1.0), 1360, 70);
    EXPECT_NEAR(optics.intensity(3.1, 1.0), 1010, 50);
    EXPECT_NEAR(optics.intensity(6.6, 1.0), 790, 40);
}

struct Moments {
    double mean_m;
    double sigma_m;
};

Moments errors_at(const Model& model, double range_m, double incidence_rad,
                  const sim::Surface& surface) {
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    for (int revolution = 0; revolution < 5; ++revolution) {
        for (const auto& reading :
             wall_seen(model.optics, range_m, incidence_rad, surface, revolution).readings) {
            if (reading.cause != sim::Cause::measured) continue;
            const double error_m = double{reading.range_m} - range_m;
            sum += error_m;
            squares += error_m * error_m;
            ++count;
        }
    }
    const double mean = sum / count;
    return {mean, std::sqrt(squares / count - mean * mean)};
}

// Soudarissanane et al. 2009: the incidence dominates the noise above 60 degrees, and hardly
// matters below 30.
TEST(UtmSight, IsNoisierOnFacesThatItMeetsAslant) {
    const Model& utm = find_model("UTM-30LX");
    const auto sigma = [&](double degrees) {
        return errors_at(utm, 5.0, degrees * degree, {.diffuse = 0.9F}).sigma_m;
    };
    const double head_on = sigma(0);
    EXPECT_LT(sigma(30) / head_on, 1.3);
    EXPECT_GT(sigma(70) / head_on, 1.5);
    EXPECT_GT(sigma(80) / head_on, sigma(70) / head_on);
}

// Kneip et al. 2009 for the URG-04LX, and others for the UTM-30LX: dark faces read farther and with
// more noise than white ones.
TEST(UtmSight, DependsOnTheColour) {
    const Model& utm = find_model("UTM-30LX");
    const Moments white = errors_at(utm, 8.0, 0.0, {.diffuse = 0.9F});
    const Moments dark = errors_at(utm, 8.0, 0.0, {.diffuse = 0.1F});
    EXPECT_NEAR(dark.mean_m - white.mean_m, 0.01 * std::log10(9.0), 0.002);
    EXPECT_GT(dark.sigma_m, 1.15 * white.sigma_m);
}

}  // namespace
}  // namespace scipd::daemon
