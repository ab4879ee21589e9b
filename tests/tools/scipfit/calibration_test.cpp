// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scanner reads too far, in worlds that are known and in rooms that several stations share:
// what was put into scipd's sensor model comes out within its intervals, and what cannot be known
// has no number.
#include "tools/scipfit/calibration.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <gmock/gmock.h>

#include "daemon/config/config_file.h"
#include "daemon/models/model_registry.h"
#include "sim/sensor/unit_bias.h"
#include "tests/tools/scipfit/synthetic_scanner.h"
#include "tools/options.h"
#include "tools/scipfit/fit.h"
#include "tools/scipfit/fit_report.h"

namespace scipd::tests {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;
using testing::ThrowsMessage;
using tools::Calibration;
using tools::FlatPose;
using tools::Interval;
using tools::ScanTable;

const Room& hall() {
    static const Room room{.length_m = 9.0,
                           .width_m = 5.0,
                           .things = {{1.5, 1.9, 0.3}, {-2.0, -1.8, 0.25}, {3.6, -1.0, 0.4}}};
    return room;
}

/// One unit of the model, without what depends on the light.
daemon::Model a_unit() {
    daemon::Model model = daemon::find_model("UST-10LX");
    model.optics.bias = sim::unit_bias(model.optics, 42);
    model.optics.receiver.walk_m = 0.0;
    return model;
}

double truth_mm(double range_mm) {
    static const daemon::Model unit = a_unit();
    return 1000.0 * unit.optics.bias_m(range_mm / 1000.0);
}

const std::vector<Place>& places() {
    static const std::vector<Place> three{{0.0, 0.0, 0.2}, {0.9, 0.6, 1.0}, {-0.8, -0.5, -0.6}};
    return three;
}

ScanTable standing_at(const std::vector<Place>& places, bool with_light = false,
                      const daemon::Model& model = a_unit(), const Room& room = hall()) {
    SyntheticScanner scanner(model, room, with_light, 21);
    ScanTable readings = scanner.begin();
    for (const Place& place : places) {
        scanner.stand(place, 100, readings);
        end_recording(readings);
    }
    return readings;
}

/// As somebody measures them, of stations that come in this order: some millimetres and a quarter
/// of a degree off.
std::vector<FlatPose> by_hand(const std::vector<Place>& places) {
    std::vector<FlatPose> measured;
    double sign = 1.0;
    for (const Place& place : places) {
        measured.push_back({1000.0 * place.x_m + 6.0 * sign, 1000.0 * place.y_m - 5.0,
                            place.yaw_rad + 0.004 * sign, 0.0});
        sign = -sign;
    }
    return measured;
}

tools::KnownWorld known_hall() {
    return tools::KnownWorld(scene_of(hall()));
}

std::vector<std::string> names_of(const tools::Unknowns& unknown) {
    std::vector<std::string> names;
    for (const tools::Unknown& one : unknown)
        names.push_back(one.parameter);
    return names;
}

bool holds(const Interval& interval, double truth) {
    return interval.low <= truth && truth <= interval.high;
}

TEST(Calibration, FindsTheCurveAndThePlacesInAWorld) {
    const ScanTable readings = standing_at(places());
    auto world = known_hall();
    const Calibration found = calibrate_in(world, tools::look_at(readings), by_hand(places()));
    ASSERT_GE(found.curve.size(), 6U);
    std::ptrdiff_t inside = 0;
    std::ostringstream shown;
    for (const tools::BiasAt& one : found.curve) {
        const double truth = truth_mm(one.range_mm);
        EXPECT_NEAR(one.bias_mm.value, truth, 0.5) << one.range_mm;
        EXPECT_LT(one.bias_mm.high - one.bias_mm.low, 4.0) << one.range_mm;
        if (holds(one.bias_mm, truth)) ++inside;
        shown << one.range_mm << ": " << one.bias_mm.low << " to " << one.bias_mm.high << ", truth "
              << truth << '\n';
    }
    EXPECT_GE(inside + 2, std::ssize(found.curve)) << shown.str();
    ASSERT_EQ(found.places.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        ASSERT_TRUE(found.places[i]);
        EXPECT_NEAR(found.places[i]->x_mm.value, 1000.0 * places()[i].x_m, 1.0);
        EXPECT_NEAR(found.places[i]->y_mm.value, 1000.0 * places()[i].y_m, 1.0);
        EXPECT_NEAR(found.places[i]->yaw_rad.value, places()[i].yaw_rad, 0.0005);
    }
}

/// A scanner with this bias by range in mm, straight between them.
daemon::Model with_bias(const std::vector<std::pair<double, double>>& points) {
    daemon::Model model = a_unit();
    model.optics.bias.clear();
    for (const auto& [range_mm, bias_mm] : points)
        model.optics.bias.push_back({range_mm / 1000.0, bias_mm / 1000.0});
    return model;
}

/// Whatever stations there are, a line has one offset and one scale.
TEST(Calibration, TellsOffsetAndScaleOfALine) {
    const daemon::Model line = with_bias({{500, 6.0}, {10000, 15.5}});
    for (const auto& stations : {std::vector(places().begin(), places().begin() + 1),
                                 std::vector(places().begin() + 1, places().end())}) {
        const ScanTable readings = standing_at(stations, false, line);
        auto world = known_hall();
        const Calibration found = calibrate_in(world, tools::look_at(readings), by_hand(stations));
        ASSERT_TRUE(found.offset_mm && found.scale_mm_per_m);
        EXPECT_TRUE(holds(*found.offset_mm, 5.5)) << found.offset_mm->value;
        EXPECT_TRUE(holds(*found.scale_mm_per_m, 1.0)) << found.scale_mm_per_m->value;
    }
}

/// A bend between knots is no smaller for that: intervals hold the truth beside it, too. Which line
/// is nearest to a bent curve hangs on where walls are, so none is told.
TEST(Calibration, TellsABentCurveButNoLineThroughIt) {
    const std::vector<std::vector<std::pair<double, double>>> bent{
        {{500, 20.0}, {2000, -10.0}, {4000, 30.0}},
        {{1000, 0.0}, {2800, 0.0}, {4000, 30.0}},
        {{1000, 10.0}, {1750, 0.0}, {3300, 10.0}}};
    std::ptrdiff_t inside = 0;
    std::ptrdiff_t all = 0;
    for (const auto& points : bent) {
        const daemon::Model model = with_bias(points);
        const ScanTable readings = standing_at(places(), false, model);
        auto world = known_hall();
        const Calibration found = calibrate_in(world, tools::look_at(readings), by_hand(places()));
        for (const tools::BiasAt& one : found.curve) {
            ++all;
            const double truth_mm = 1000.0 * model.optics.bias_m(one.range_mm / 1000.0);
            if (holds(one.bias_mm, truth_mm)) ++inside;
        }
        EXPECT_FALSE(found.offset_mm || found.scale_mm_per_m);
        EXPECT_THAT(names_of(found.unknown), IsSupersetOf({"offset", "scale"}));
    }
    EXPECT_GT(all, 20);
    EXPECT_GE(inside + 2, all);
}

/// What is advised where one station tells no offset.
TEST(Calibration, FindsTheOffsetByThreeStationsThatAreApartAndTurned) {
    const daemon::Model line = with_bias({{500, 12.0}, {10000, 12.0}});
    const Room empty{};
    const Room with_two_boxes{.things = {{1.8, -1.3, 0.3}, {1.5, 1.5, 0.2}}};
    for (const Room& room : {hall(), empty, with_two_boxes}) {
        const std::vector<Place> apart{{0.3, 0.1, 0.0}, {-0.7, -0.4, 1.2}, {-1.0, 0.6, -0.9}};
        const ScanTable readings = standing_at(apart, false, line, room);
        const tools::Standing standing = tools::look_at(readings);
        const auto shared = tools::shared_room(standing);
        ASSERT_TRUE(shared);
        const Calibration found = calibrate_in(*shared, standing);
        ASSERT_TRUE(found.offset_mm) << room.length_m << ' ' << room.things.size();
        EXPECT_NEAR(found.offset_mm->value, 12.0, 1.0);
        EXPECT_LT(found.offset_mm->high - found.offset_mm->low, 10.0);
    }
}

TEST(Calibration, FindsTheCurveButForASlopeInARoomOfItsOwn) {
    const ScanTable readings = standing_at(places());
    const tools::Standing standing = tools::look_at(readings);
    const auto room = tools::shared_room(standing);
    ASSERT_TRUE(room);
    const Calibration found = calibrate_in(*room, standing);
    EXPECT_EQ(found.stations, 3U);
    EXPECT_THAT(names_of(found.unknown), Contains("scale"));
    EXPECT_FALSE(found.scale_mm_per_m);
    const auto& knots = found.fit.knots_mm;
    std::vector<double> truth;
    for (const double knot : knots)
        truth.push_back(truth_mm(knot));
    const tools::LineThrough line = tools::line_through(knots, truth);
    EXPECT_TRUE(found.but_for_slope);
    EXPECT_FALSE(found.offset_mm);  // a unit's curve is no line
    ASSERT_EQ(found.curve.size(), knots.size());
    for (std::size_t i = 0; i < knots.size(); ++i)
        EXPECT_NEAR(found.curve[i].bias_mm.value, line.at_zero + line.left[i], 3.0) << knots[i];
}

TEST(Calibration, TellsHowBrightFacesAreByTheirAngle) {
    const ScanTable readings = standing_at(places(), true);
    auto world = known_hall();
    const Calibration found = calibrate_in(world, tools::look_at(readings), by_hand(places()));
    const auto light = tools::light_of_faces(found);
    ASSERT_TRUE(light);
    ASSERT_GE(light->incidence.size(), 2U);
    for (const tools::IncidenceAt& one : light->incidence)
        EXPECT_NEAR(one.share.value, std::cos(one.incidence_rad), 0.02);
    // The walls send back 0.9, 0.7, 0.5 and 0.3 of the light.
    ASSERT_GE(light->surfaces.size(), 4U);
    for (std::size_t i : {0U, 1U, 3U})
        ASSERT_TRUE(light->surfaces[i].intensity);
    const double white = light->surfaces[0].intensity->value / 0.9;
    EXPECT_NEAR(light->surfaces[1].intensity->value / white, 0.7, 0.02);
    EXPECT_NEAR(light->surfaces[3].intensity->value / white, 0.3, 0.02);
}

/// The profile that scipfit writes is the twin, as scipd reads it.
TEST(Calibration, IsTheTwinThatScipdReads) {
    const ScanTable readings = standing_at(places());
    auto world = known_hall();
    const tools::Given given{.world = &world, .places = by_hand(places())};
    const tools::Fit fit =
        tools::fit_scanner(tools::look_at(readings), tools::kind_of(readings, ""), given);
    std::ostringstream out;
    write_profile(fit, {.place = fit.calibration->fit.places[0]}, out);
    EXPECT_THAT(out.str(), HasSubstr("measured (synthetic, "));
    const auto config = daemon::parse_config(out.str(), "twin.yaml");
    const sim::SensorSpec& optics = config.robots.at(0).sensors.at(0).model.optics;
    ASSERT_EQ(optics.bias.size(), fit.bias.size());
    for (const double range_m : {1.5, 2.5, 4.0})
        EXPECT_NEAR(1000.0 * optics.bias_m(range_m), truth_mm(1000.0 * range_m), 1.5);
}

TEST(Calibration, TellsNoOffsetOfOneWallHeadOn) {
    const std::vector<Place> one{{-2.0, 0.0, 1.5708}};
    const ScanTable readings = only(standing_at(one), 480, 600);
    auto world = known_hall();
    const tools::Given given{.world = &world, .places = by_hand(one)};
    const tools::Fit found =
        tools::fit_scanner(tools::look_at(readings), tools::kind_of(readings, ""), given);
    EXPECT_THAT(names_of(found.unknown), IsSupersetOf({"offset", "scale", "pose"}));
    EXPECT_TRUE(found.bias.empty());
    EXPECT_FALSE(found.face_light);  // there are no intensities
    const auto bias = tools::as_json(found)["bias"];
    EXPECT_TRUE(bias["points"].empty());
    EXPECT_TRUE(bias["offset_mm"].is_null());
    EXPECT_TRUE(bias["scale_mm_per_m"].is_null());
    EXPECT_TRUE(bias["places"][0].is_null());
}

TEST(Calibration, RefusesAPoseFromWhereTheWorldLooksOtherwise) {
    const ScanTable readings = standing_at({places()[0]});
    auto world = known_hall();
    const auto elsewhere = by_hand({{2.0, 1.0, 2.5}});
    EXPECT_THAT([&] { (void)calibrate_in(world, tools::look_at(readings), elsewhere); },
                ThrowsMessage<tools::WrongInput>(HasSubstr("are the poses right?")));
}

}  // namespace
}  // namespace scipd::tests
