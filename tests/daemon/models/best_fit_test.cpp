// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which product stands for the lidar of a world: worked out by hand from the data of each.
#include "daemon/models/best_fit.h"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "daemon/models/model_registry.h"

namespace scipd::daemon {
namespace {

/// What a UST-10LX says of itself: 270 degrees, 0.25 each.
sim::Lidar hokuyo() {
    return {.samples = 1081,
            .rows = 1,
            .min_angle_rad = -2.35619,
            .max_angle_rad = 2.35619,
            .min_range_m = 0.02,
            .max_range_m = 30.0,
            .rate_hz = 40.0};
}

std::string best(const sim::Lidar& lidar) {
    return best_fit(lidar).profile.name;
}

TEST(BestFit, IsTheProductOfWhichTheFiguresAre) {
    EXPECT_EQ(best(hokuyo()), "UST-10LX");
    EXPECT_NEAR(misfit(find_model("UST-10LX"), hokuyo()), 0.0, 1e-4);
    EXPECT_EQ(differences(find_model("UST-10LX"), hokuyo()), "");

    sim::Lidar lidar = hokuyo();
    lidar.samples = 2161;
    EXPECT_EQ(best(lidar), "UST-10LX-H01");
    lidar = hokuyo();
    lidar.max_range_m = 60.0;
    lidar.min_range_m = 0.023;
    EXPECT_EQ(best(lidar), "UTM-30LX");  // before others with the same figures
    // hokuyo_urg_04lx.
    EXPECT_EQ(best({.samples = 682,
                    .rows = 1,
                    .min_angle_rad = -2.0944,
                    .max_angle_rad = 2.0920,
                    .min_range_m = 0.02,
                    .max_range_m = 5.6,
                    .rate_hz = 10.0}),
              "URG-04LX");
    // One that is as this, but faster.
    EXPECT_EQ(best({.samples = 682,
                    .rows = 1,
                    .min_angle_rad = -2.0944,
                    .max_angle_rad = 2.0920,
                    .min_range_m = 0.02,
                    .max_range_m = 5.6,
                    .rate_hz = 35.0}),
              "UBG-04LX-F01");
}

TEST(BestFit, CountsFactorsEitherWay) {
    const Model& ust = find_model("UST-10LX");
    for (const double factor : {2.0, 0.5}) {
        sim::Lidar lidar = hokuyo();
        lidar.rate_hz *= factor;
        EXPECT_NEAR(misfit(ust, lidar), 0.8 * 0.6931, 1e-3);
    }
    // Beyond the 30 m that it reports, below the 10 m that are guaranteed.
    for (const double range_m : {60.0, 5.0}) {
        sim::Lidar lidar = hokuyo();
        lidar.max_range_m = range_m;
        EXPECT_NEAR(misfit(ust, lidar), 2 * 0.6931, 1e-3);
    }
    // A field of view that is too narrow.
    sim::Lidar wide = hokuyo();
    wide.samples = 1441;
    wide.min_angle_rad = -std::numbers::pi;
    wide.max_angle_rad = std::numbers::pi;
    EXPECT_NEAR(misfit(ust, wide), 4 * 0.2877, 1e-3);
}

/// 270 degrees at 40 Hz.
sim::Lidar of_data_sheet(double min_range_m, double max_range_m, int samples = 1081) {
    sim::Lidar lidar = hokuyo();
    lidar.min_range_m = min_range_m;
    lidar.max_range_m = max_range_m;
    lidar.samples = samples;
    return lidar;
}

TEST(BestFit, IsTheProductOfWhichTheDataSheetIs) {
    EXPECT_EQ(best(of_data_sheet(0.06, 5.0, 541)), "UST-05LX");
    EXPECT_EQ(best(of_data_sheet(0.06, 10.0)), "UST-10LX");
    EXPECT_EQ(best(of_data_sheet(0.06, 20.0)), "UST-20LX");
    EXPECT_EQ(best(of_data_sheet(0.1, 30.0)), "UTM-30LX");
    for (const double nearest_m : {0.02, 0.06}) {
        for (const double farthest_m : {4.0, 4.095, 5.6}) {
            for (const int samples : {682, 683, 726}) {
                const sim::Lidar lidar{.samples = samples,
                                       .rows = 1,
                                       .min_angle_rad = -2.0944,
                                       .max_angle_rad = 2.0944,
                                       .min_range_m = nearest_m,
                                       .max_range_m = farthest_m,
                                       .rate_hz = 10.0};
                EXPECT_EQ(best(lidar), "URG-04LX") << samples << " to " << farthest_m;
            }
        }
    }
}

TEST(BestFit, OfOthersIsOneOfTheirRange) {
    // Half a turn of gpu_laser in Gazebo's lessons.
    sim::Lidar half = of_data_sheet(0.1, 30.0, 720);
    half.min_angle_rad = -1.570796;
    half.max_angle_rad = 1.570796;
    EXPECT_EQ(best(half), "UTM-30LX");
    // An RPLIDAR or LDS: of 8 m or 10 m, and no faster than need be.
    const sim::Lidar lds{.samples = 360,
                         .rows = 1,
                         .min_angle_rad = -3.14159,
                         .max_angle_rad = 3.14159,
                         .min_range_m = 0.12,
                         .max_range_m = 12.0,
                         .rate_hz = 10.0};
    EXPECT_EQ(best(lds), "UHG-08LX");
}

// A UXM-30LX-E, of 190 degrees, has their rate, and would leave a third of their view out.
TEST(BestFit, HasTheFieldOfViewBeforeTheRate) {
    for (const double rate_hz : {10.0, 20.0, 25.0}) {
        sim::Lidar lidar = of_data_sheet(0.1, 29.0);
        lidar.rate_hz = rate_hz;
        EXPECT_EQ(best(lidar), "UTM-30LX") << rate_hz;
    }
    sim::Lidar narrow = of_data_sheet(0.1, 30.0, 761);
    narrow.min_angle_rad = -1.6580;
    narrow.max_angle_rad = 1.6580;
    narrow.rate_hz = 20.0;
    EXPECT_EQ(best(narrow), "UXM-30LX-E");
}

// A UST-05LX has their steps, and sees half as far.
TEST(BestFit, HasTheRangeBeforeTheSteps) {
    for (const double rate_hz : {0.0, 10.0, 20.0, 40.0, 50.0}) {
        sim::Lidar lidar = of_data_sheet(0.1, 29.0, 541);
        lidar.rate_hz = rate_hz;
        EXPECT_EQ(best(lidar), "UTM-30LX") << rate_hz;
        EXPECT_GT(misfit(find_model("UST-05LX"), lidar), misfit(find_model("UST-10LX"), lidar));
    }
}

TEST(BestFit, WhatTheFileLeavesOpenCountsNothing) {
    sim::Lidar lidar = hokuyo();
    lidar.rate_hz = 0.0;
    lidar.max_range_m = std::numeric_limits<double>::infinity();
    EXPECT_NEAR(misfit(find_model("UST-10LX"), lidar), 0.0, 1e-4);
    lidar.samples = 1;
    lidar.min_angle_rad = lidar.max_angle_rad = 0.0;
    EXPECT_NEAR(misfit(find_model("UST-10LX"), lidar), 0.0, 1e-4);
}

TEST(BestFit, TellsWhatIsUnlike) {
    // An LDS-01.
    const sim::Lidar lds{.samples = 360,
                         .rows = 4,
                         .min_angle_rad = 0.0,
                         .max_angle_rad = 6.28319,
                         .min_range_m = 0.12,
                         .max_range_m = 3.5,
                         .rate_hz = 5.0};
    EXPECT_EQ(differences(find_model("UST-10LX"), lds),
              "0.02 to 30 m instead of 0.12 to 3.5 m, -135 to 135 deg instead of 0 to 360 deg, "
              "1081 steps instead of 360, 40 Hz instead of 5 Hz, one row instead of 4");
}

TEST(RecordedModel, IsNoProductWhereNoneHasItsFanStepsAndRange) {
    EXPECT_EQ(missing_in_best_fit(hokuyo()), "");
    EXPECT_EQ(recorded_model(hokuyo()).profile.name, "UST-10LX");
    sim::Lidar around = hokuyo();
    around.samples = 720;
    around.min_angle_rad = 0.0;
    around.max_angle_rad = 719 * 2 * std::numbers::pi / 720;
    EXPECT_EQ(missing_in_best_fit(around), "-135 to 135 deg instead of 0 to 359.5 deg");
    EXPECT_EQ(recorded_model(around).profile.name, "recorded");
    sim::Lidar coarse = hokuyo();
    coarse.samples = 676;
    EXPECT_EQ(missing_in_best_fit(coarse), "steps of 0.25 deg instead of 0.4 deg");
    // Every second step of the product.
    coarse.samples = 541;
    EXPECT_EQ(missing_in_best_fit(coarse), "");
}

TEST(RecordedModel, IsTheProductThatTheRecordingNames) {
    const auto named = [](const std::string& text, const std::string& firmware = {}) {
        const Model* const model = model_named_in(text, firmware);
        return model == nullptr ? "" : model->profile.name;
    };
    EXPECT_EQ(named("SOKUIKI Sensor TOP-URG UTM-30LX(Hokuyo Automatic Co.,Ltd.)"), "UTM-30LX");
    EXPECT_EQ(named("UTM-30LX-EW"), "UTM-30LX-EW");
    EXPECT_EQ(named("LMS100"), "");
    EXPECT_EQ(named(""), "");
    // Some products and firmwares have one and the same model in their answers.
    for (const Model& model : models())
        EXPECT_EQ(named(model.profile.model, model.profile.firmware), model.profile.name);
}

TEST(RecordedModel, HasTheFanOfTheRecording) {
    const sim::Lidar lidar = recorded_lidar({.first_rad = 1.0, .increment_rad = -0.5}, 3,
                                            {.min_range_m = 0.1, .max_range_m = 4.0}, 10.0);
    EXPECT_EQ(lidar.samples, 3);
    EXPECT_DOUBLE_EQ(lidar.min_angle_rad, 0.0);
    EXPECT_DOUBLE_EQ(lidar.max_angle_rad, 1.0);
    EXPECT_DOUBLE_EQ(lidar.max_range_m, 4.0);
}

}  // namespace
}  // namespace scipd::daemon
