// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Recordings that do not tell everything: what is said of them, and that no number is told for what
// is not known.
#include "tools/scipfit/fit.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include <gmock/gmock.h>

#include "daemon/models/model_registry.h"
#include "tests/tools/scipfit/synthetic_scanner.h"
#include "tools/options.h"
#include "tools/scipfit/fit_report.h"
#include "tools/scipfit/known_length.h"

namespace scipd::tests {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;
using testing::ThrowsMessage;
using tools::Fit;
using tools::ScanTable;

const daemon::Model& ust() {
    return daemon::find_model("UST-10LX");
}

Fit fit(const ScanTable& readings, const std::vector<tools::Length>& lengths = {}) {
    return tools::fit_scanner(tools::look_at(readings), tools::kind_of(readings, ""),
                              {.lengths = lengths});
}

std::vector<std::string> unknown_of(const Fit& fit) {
    std::vector<std::string> names;
    for (const tools::Unknown& one : fit.unknown) {
        EXPECT_NE(one.why, "");
        EXPECT_NE(one.would_tell, "");
        names.push_back(one.parameter);
    }
    return names;
}

ScanTable standing(int scans, bool with_light = false, const Room& room = {},
                   const Place& place = {}) {
    SyntheticScanner scanner(ust(), room, with_light, 3);
    ScanTable readings = scanner.begin();
    scanner.stand(place, scans, readings);
    end_recording(readings);
    return readings;
}

TEST(Fit, DoesNotTellOffsetOrScaleOfOneRoom) {
    const Fit found = fit(standing(100));
    EXPECT_THAT(unknown_of(found), IsSupersetOf({"offset", "scale", "angle_offset", "warm_up"}));
    EXPECT_THAT(unknown_of(found), Not(Contains("sigma")));
    const auto json = tools::as_json(found);
    EXPECT_TRUE(json["bias"].is_null());
    EXPECT_FALSE(json["sigma"]["steps"].empty());
}

TEST(Fit, TellsNoiseButNoPlaceOfOnePlane) {
    const Fit found = fit(only(standing(100), 480, 600));
    EXPECT_THAT(unknown_of(found), IsSupersetOf({"offset", "scale", "mixed_beams"}));
    ASSERT_TRUE(found.noise);
    EXPECT_EQ(found.noise->model.steps.size(), 1U);
}

TEST(Fit, TellsNoiseButNoPlaceOfTwoParallelWalls) {
    Room corridor{.length_m = 60.0, .width_m = 3.0};
    const Fit found = fit(standing(100, false, corridor));
    EXPECT_THAT(unknown_of(found), IsSupersetOf({"offset", "scale", "angle_offset"}));
    EXPECT_TRUE(found.noise);
}

TEST(Fit, TellsNoLawOfLightWithoutIntensities) {
    const Fit found = fit(standing(100));
    EXPECT_THAT(unknown_of(found), Contains("i0"));
    const auto json = tools::as_json(found);
    EXPECT_EQ(json["sigma"]["law"], "range");
    EXPECT_TRUE(json["sigma"]["s0_mm"].is_null());
    EXPECT_TRUE(json["sigma"]["i0"].is_null());
    EXPECT_TRUE(json["intensity_noise"].empty());
}

/// At `accuracy: sensor` slanted walls are dimmer, but no noisier.
TEST(Fit, TellsNoLawOfLightWhereNoiseGoesByTheRange) {
    daemon::Model model = ust();
    model.optics.receiver.dark_range_m = 6.0;
    model.optics.noise_law = {.floor_m = 0.005, .weak = 1000.0};
    for (const std::uint64_t seed : {5U, 6U}) {
        SyntheticScanner scanner(model, {}, false, seed);
        scanner.tell_intensities();
        ScanTable readings = scanner.begin();
        scanner.stand({.x_m = 0.4, .yaw_rad = 0.7}, 120, readings);
        end_recording(readings);
        const Fit found = fit(readings);
        ASSERT_TRUE(found.noise);
        EXPECT_FALSE(found.noise->model.by_intensity);
        EXPECT_THAT(unknown_of(found), Contains("i0"));
        EXPECT_TRUE(tools::as_json(found)["sigma"]["s0_mm"].is_null());
    }
}

/// The longer of two stations was recorded without intensities.
TEST(Fit, TellsTheLawOfLightOfThoseThatHaveIntensities) {
    SyntheticScanner scanner(ust(), {}, true, 5);
    ScanTable readings = scanner.begin();
    scanner.stand({}, 80, readings);
    const std::size_t with_light = readings.ranges_mm.size();
    scanner.stand({.x_m = 0.5, .yaw_rad = 1.0}, 120, readings);
    end_recording(readings);
    std::fill(readings.intensities.begin() + static_cast<std::ptrdiff_t>(with_light),
              readings.intensities.end(), tools::no_number);
    testing::internal::CaptureStderr();
    const Fit found = fit(readings);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");  // Ceres warns of what is not finite
    ASSERT_TRUE(found.noise && found.noise->model.by_intensity && found.held_out);
    EXPECT_NEAR(found.noise->s0_mm.value, 1000.0 * ust().optics.noise_law.floor_m, 0.3);
    EXPECT_NEAR(found.noise->i0.value / ust().optics.noise_law.weak, 1.0, 0.1);
    EXPECT_GT(found.noise->dimmest, 0.0);
    EXPECT_NEAR(found.held_out->coverage_95, 0.95, 0.01);
    EXPECT_GT(found.light.noise.front().intensity, 0.0);
}

// All faces are so bright that their noise is the floor's.
TEST(Fit, TellsNoLawOfLightThatDoesNotMatter) {
    daemon::Model model = ust();
    model.optics.noise_law = {.floor_m = 0.006, .weak = 5.0};
    SyntheticScanner scanner(model, {}, true, 5);
    ScanTable readings = scanner.begin();
    scanner.stand({}, 100, readings);
    end_recording(readings);
    const Fit found = fit(readings);
    EXPECT_THAT(unknown_of(found), Contains("i0"));
    ASSERT_TRUE(found.noise);
    EXPECT_FALSE(found.noise->model.by_intensity);
    EXPECT_NEAR(found.noise->s0_mm.value, 6.0, 0.1);
}

TEST(Fit, TellsDriftInScansWhereThereAreNoTimes) {
    ScanTable readings = standing(100);
    for (tools::ScanTime& time : readings.times)
        time.host_s.reset();
    std::ostringstream text;
    tools::show(fit(readings), text);
    EXPECT_THAT(text.str(), HasSubstr(" mm in 100 scans\n"));
}

TEST(Fit, TellsNoNoiseOfTenScans) {
    const Fit found = fit(standing(10));
    EXPECT_THAT(unknown_of(found), IsSupersetOf({"sigma", "neighbours"}));
    const auto json = tools::as_json(found);
    EXPECT_TRUE(json["sigma"].is_null());
    EXPECT_TRUE(json["neighbours"].is_null());
    EXPECT_TRUE(json["next_scan"].is_null());
    EXPECT_TRUE(json["held_out"].is_null());
}

TEST(Fit, TellsNoNoiseWhereEverythingMoves) {
    SyntheticScanner scanner(ust(), {}, false, 3);
    ScanTable readings = scanner.begin();
    for (int i = 0; i < 120; ++i)
        scanner.stand({-1.2 + 0.02 * i, 0.0, 0.01 * i}, 1, readings);
    end_recording(readings);
    const Fit found = fit(readings);
    EXPECT_THAT(unknown_of(found), IsSupersetOf({"sigma", "neighbours", "drift"}));
    EXPECT_TRUE(tools::as_json(found)["sigma"].is_null());
    EXPECT_EQ(found.beams, 0U);
}

TEST(Fit, NamesAnotherKindOfScanner) {
    ScanTable readings = standing(60);
    readings.identity = {.model = "LMS100"};
    const Fit found = fit(readings);
    EXPECT_FALSE(found.kind.known);
    EXPECT_THAT(found.kind.from, HasSubstr("the recording is of a LMS100"));
    EXPECT_THAT(unknown_of(found), Contains("model"));
}

TEST(Fit, FindsMediansOfFiveBeams) {
    SyntheticScanner scanner(daemon::find_model("UTM-30LX"), {}, false, 3);
    ScanTable readings = scanner.begin();
    scanner.stand({}, 100, readings);
    end_recording(readings);
    const Fit found = fit(readings);
    ASSERT_TRUE(found.smoothing);
    EXPECT_TRUE(found.smoothing->smoothing.median_of_five);
    EXPECT_GT(found.smoothing->equal, 0.35);
}

TEST(Fit, CountsCodesByPlace) {
    const Fit found = fit(only(standing(60), 200, 799));
    ASSERT_TRUE(found.codes.codes.contains(65533));
    EXPECT_EQ(found.codes.usual(), 65533U);
    EXPECT_EQ(found.codes.codes.at(65533).all(), 60.0 * (200 + 281));
    EXPECT_EQ(found.codes.codes.at(65533).beside, 60.0 * 2);
}

TEST(Fit, HoldsForScansThatItWasNotFittedTo) {
    const Fit found = fit(standing(120));
    ASSERT_TRUE(found.held_out);
    EXPECT_NEAR(found.held_out->coverage_95, 0.95, 0.01);
    EXPECT_LT(found.held_out->nll, found.held_out->nll_sheet - 0.5);
    EXPECT_LT(found.held_out->nll, found.held_out->nll_per_beam + 0.05);
}

// Opposite walls of the room are 6 m apart, and the scanner reads 8 mm too far.
TEST(Fit, TellsTheBiasByALength) {
    daemon::Model model = ust();
    model.optics.bias = {{1.0, 0.008}};
    SyntheticScanner scanner(model, {}, false, 3);
    ScanTable readings = scanner.begin();
    scanner.stand({.yaw_rad = M_PI / 2}, 200, readings);
    end_recording(readings);
    const tools::Length across = tools::parse_length_between("180:900=6m");
    const Fit found = fit(readings, {across});
    ASSERT_EQ(found.bias.size(), 1U);
    EXPECT_LE(found.bias[0].bias_mm.low, 8.0);
    EXPECT_GE(found.bias[0].bias_mm.high, 8.0);
    EXPECT_NEAR(found.bias[0].range_mm, 3000.0, 20.0);
    EXPECT_THAT(unknown_of(found), Not(Contains("offset")));
}

TEST(Fit, RefusesLengthsThatCannotBe) {
    const ScanTable readings = standing(60);
    const auto expect_refused = [&](const tools::Length& length, const auto& message) {
        EXPECT_THAT([&] { (void)fit(readings, {length}); },
                    ThrowsMessage<tools::WrongInput>(message));
    };
    expect_refused({180, 2000, 6.0}, "--length: step 2000 is not recorded");
    expect_refused({500, 501, 6.0}, HasSubstr("name two that are far apart"));
    constexpr double in_mm = 4000.0;
    expect_refused({180, 900, in_mm}, HasSubstr("m between them, not 4000.000 m"));
    for (const char* text : {"", "180", "180:900", "a:900=3m", "180:900=-3m", "180:900=x"})
        EXPECT_THAT([&] { (void)tools::parse_length_between(text); },
                    ThrowsMessage<tools::WrongInput>(HasSubstr("must be STEP:STEP=METRES")))
            << text;
}

}  // namespace
}  // namespace scipd::tests
