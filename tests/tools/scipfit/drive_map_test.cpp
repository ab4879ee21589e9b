// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A building whose walls are known comes back as a map from a drive through it, which is a log of
// CARMEN. Ranges are computed here, from walls along the axes.
#include "tools/scipfit/drive_map.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <vector>

#include <gmock/gmock.h>

#include "sim/backends/embree.h"
#include "sim/loaders/scene_file.h"
#include "tests/support/child.h"
#include "tests/support/temp_dir.h"
#include "tools/options.h"

namespace scipd::tests {
namespace {

using sim::MapCell;
using testing::Ge;
using testing::HasSubstr;
using testing::Not;
using tools::DriveMap;
using tools::LaserPose;
using tools::Point;

constexpr int beams = 361;
constexpr double first_rad = -0.75 * std::numbers::pi;
constexpr double beam_rad = 1.5 * std::numbers::pi / (beams - 1);

/// A box along the axes, seen from within or from outside.
struct Box {
    Point low, high;
};
const std::vector<Box> building = {{{-3, -2}, {5, 2}}, {{2.0, 0.4}, {2.6, 1.0}}};

/// From a point in a direction to the nearest side of any box.
double range_m(const Point& from, double angle_rad) {
    const double dx = std::cos(angle_rad);
    const double dy = std::sin(angle_rad);
    double nearest_m = 100.0;
    const auto meet = [&](double m, double across, double low, double high) {
        if (m > 1e-9 && across >= low && across <= high) nearest_m = std::min(nearest_m, m);
    };
    for (const Box& box : building) {
        for (const double x_m : {box.low.x_m, box.high.x_m}) {
            const double m = (x_m - from.x_m) / dx;
            meet(m, from.y_m + m * dy, box.low.y_m, box.high.y_m);
        }
        for (const double y_m : {box.low.y_m, box.high.y_m}) {
            const double m = (y_m - from.y_m) / dy;
            meet(m, from.x_m + m * dx, box.low.x_m, box.high.x_m);
        }
    }
    return nearest_m;
}

double off_walls_m(const Point& point) {
    double nearest_m = 100.0;
    for (const Box& box : building) {
        const double along_x = std::clamp(point.x_m, box.low.x_m, box.high.x_m);
        const double along_y = std::clamp(point.y_m, box.low.y_m, box.high.y_m);
        for (const double x_m : {box.low.x_m, box.high.x_m})
            nearest_m = std::min(nearest_m, std::hypot(point.x_m - x_m, point.y_m - along_y));
        for (const double y_m : {box.low.y_m, box.high.y_m})
            nearest_m = std::min(nearest_m, std::hypot(point.x_m - along_x, point.y_m - y_m));
    }
    return nearest_m;
}

/// Along the building and back, turning on the way; it begins at the origin and looks along x.
std::vector<LaserPose> lap() {
    std::vector<LaserPose> places;
    for (int i = 0; i < 120; ++i) {
        const double t = i / 120.0;
        const double out = 1.0 - std::abs(2.0 * t - 1.0);
        places.push_back({3.5 * out, -0.8 * out, 2.0 * std::numbers::pi * t});
    }
    return places;
}

/// Odometry that takes each motion for a hundredth more than it is, and slips to the left.
std::vector<LaserPose> slipping(const std::vector<LaserPose>& places) {
    std::vector<LaserPose> told{places.front()};
    for (std::size_t i = 1; i < places.size(); ++i) {
        LaserPose moved = tools::relative(places[i - 1], places[i]);
        moved.x_m *= 1.01;
        moved.yaw_rad += 0.002;
        told.push_back(tools::compose(told.back(), moved));
    }
    return told;
}

class DriveMapTest : public testing::Test {
  protected:
    /// `end_m`: what the laser tells of all that is farther, without saying so.
    std::filesystem::path log(const std::vector<LaserPose>& places,
                              const std::vector<LaserPose>& told, double end_m = 0.0) {
        std::ostringstream text;
        text << std::setprecision(9);
        for (std::size_t i = 0; i < places.size(); ++i) {
            text << "ROBOTLASER1 0 " << first_rad << ' ' << beams * beam_rad << ' ' << beam_rad
                 << (end_m > 0.0 ? " 0" : " 30") << " 0.01 0 " << beams;
            for (int k = 0; k < beams; ++k)
                text << ' ' << told_m(places[i], first_rad + k * beam_rad, end_m);
            // From an origin of its own.
            const LaserPose& at = told[i];
            text << " 0 " << 7.0 - at.y_m << ' ' << 3.0 + at.x_m << ' '
                 << at.yaw_rad + std::numbers::pi / 2 << " 0 0 0 0 0 0 0 0 " << 1700000000 + i
                 << " host " << i << '\n';
        }
        return folder_.write("drive.log", text.str());
    }

    static double told_m(const LaserPose& at, double angle_rad, double end_m) {
        const double m = range_m({at.x_m, at.y_m}, at.yaw_rad + angle_rad);
        return end_m > 0.0 ? std::min(m, end_m) : m;
    }

    TempDir folder_;
};

std::vector<Point> faces_of(const sim::FloorMap& map) {
    std::vector<Point> faces;
    for (std::size_t row = 0; row < map.rows; ++row) {
        for (std::size_t column = 0; column < map.columns; ++column) {
            if (map.at(column, row) != MapCell::occupied) continue;
            faces.push_back(
                {map.origin_m.x + (static_cast<double>(column) + 0.5) * map.resolution_m,
                 map.origin_m.y + (static_cast<double>(row) + 0.5) * map.resolution_m});
        }
    }
    return faces;
}

/// The share of the walls' length that has a face within `near_m`.
double share_found(const std::vector<Point>& faces, double near_m) {
    int found = 0;
    int all = 0;
    for (const Box& box : building) {
        const double length_m = box.high.x_m - box.low.x_m;
        for (double along_m = 0.1; along_m < length_m; along_m += 0.1) {
            for (const double y_m : {box.low.y_m, box.high.y_m}) {
                ++all;
                found += std::ranges::any_of(faces, [&](const Point& face) {
                    return std::hypot(face.x_m - box.low.x_m - along_m, face.y_m - y_m) < near_m;
                });
            }
        }
    }
    return static_cast<double>(found) / all;
}

TEST_F(DriveMapTest, HasTheWallsWhereTheyAre) {
    const DriveMap made = tools::map_of(tools::read_drive(log(lap(), lap()), ""), 0.05);
    EXPECT_FALSE(made.refined);
    EXPECT_EQ(made.readings, 120U * beams);
    EXPECT_THAT(made.explained, Ge(made.readings * 97 / 100));
    const auto faces = faces_of(made.map);
    for (const Point& face : faces)
        EXPECT_LT(off_walls_m(face), 0.05) << face.x_m << ' ' << face.y_m;
    EXPECT_GT(share_found(faces, 0.06), 0.95);
}

TEST_F(DriveMapTest, HasNoWallWhereALaserSeesNoFarther) {
    const DriveMap made = tools::map_of(tools::read_drive(log(lap(), lap(), 3.0), ""), 0.05);
    EXPECT_FALSE(made.refined);
    for (const Point& face : faces_of(made.map))
        EXPECT_LT(off_walls_m(face), 0.05) << face.x_m << ' ' << face.y_m;
}

TEST_F(DriveMapTest, IsNoneWhereNothingIsMetTwice) {
    EXPECT_THROW((void)tools::map_of(tools::read_drive(log(lap(), lap(), 0.06), ""), 0.05),
                 tools::WrongInput);
}

TEST_F(DriveMapTest, LaysScansOverEachOtherWhereOdometrySlips) {
    const auto told = slipping(lap());
    EXPECT_GT(std::hypot(told.back().x_m - lap().back().x_m, told.back().y_m - lap().back().y_m),
              0.2);
    const DriveMap made = tools::map_of(tools::read_drive(log(lap(), told), ""), 0.05);
    EXPECT_TRUE(made.refined);
    EXPECT_GT(made.most_moved_m, 0.15);
    EXPECT_THAT(made.explained, Ge(made.readings * 95 / 100));
    const auto faces = faces_of(made.map);
    const auto astray =
        std::ranges::count_if(faces, [](const Point& face) { return off_walls_m(face) > 0.15; });
    EXPECT_LT(astray, static_cast<std::ptrdiff_t>(faces.size()) / 20);
    EXPECT_GT(share_found(faces, 0.15), 0.95);
}

TEST_F(DriveMapTest, IsAWorldThatScipdSeesAlike) {
    const auto world = folder_.path() / "hall.yaml";
    const Outcome made = run({SCIPFIT, "room", log(lap(), lap()).string(), "-o", world.string()});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("120 scans; the map explains"));
    EXPECT_THAT(made.out, HasSubstr("the places are those that the recording has"));
    EXPECT_THAT(made.out, Not(HasSubstr("that is little")));
    const auto backend = sim::make_embree_backend(sim::load_scene(world, {}).scene);
    for (const double angle_rad : {0.0, 0.5, 1.8, -1.2, 3.0}) {
        const std::vector<glm::vec3> directions = {
            {std::cos(angle_rad), std::sin(angle_rad), 0.0F}};
        const std::vector<sim::Pose> poses = {{.translation_m = {0.0, 0.0, 0.2}}};
        std::vector<sim::Hit> hits(1);
        backend->cast({.directions = directions, .world_from_sensor = poses, .max_range_m = 30.0F},
                      hits);
        EXPECT_NEAR(hits[0].range_m, range_m({0, 0}, angle_rad), 0.08) << angle_rad;
    }
}

TEST_F(DriveMapTest, SaysWhereItExplainsLittle) {
    auto told = lap();
    for (LaserPose& place : told)
        place.yaw_rad *= 180.0 / std::numbers::pi;
    EXPECT_THAT(tools::as_text(tools::map_of(tools::read_drive(log(lap(), told), ""), 0.05)),
                HasSubstr("are the poses in metres and radians"));
}

TEST_F(DriveMapTest, LeavesOutScansWhosePlaceIsNoNumber) {
    auto told = lap();
    told.front().x_m = std::nan("");
    told[50].yaw_rad = std::nan("");
    const DriveMap made = tools::map_of(tools::read_drive(log(lap(), told), ""), 0.05);
    EXPECT_EQ(made.scans, 118U);
    EXPECT_EQ(made.without_place, 2U);
    EXPECT_THAT(tools::as_text(made), HasSubstr("do not say where the scanner was: 2 scans"));
    EXPECT_THAT(made.explained, Ge(made.readings * 97 / 100));
}

TEST_F(DriveMapTest, NeedsPoses) {
    const auto file =
        folder_.write("raw.log", "RAWLASER1 0 -1.5 3 0.75 30 0.01 0 3 1 2 3 0 1 h 1\n");
    try {
        (void)tools::read_drive(file, "");
        FAIL();
    } catch (const tools::WrongInput& error) {
        EXPECT_THAT(error.what(), HasSubstr("does not say where the scanner was"));
        EXPECT_THAT(error.what(), HasSubstr("-o room.sdf"));
    }
    const Outcome refused =
        run({SCIPFIT, "room", file.string(), "-o", (folder_.path() / "no.yaml").string()});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "no.yaml"));
    const Outcome misnamed =
        run({SCIPFIT, "room", file.string(), "-o", (folder_.path() / "no.yml").string()});
    EXPECT_EQ(misnamed.exit_code, 2);
    EXPECT_THAT(misnamed.err, HasSubstr("must end with .yaml"));
}

TEST_F(DriveMapTest, RefusesPosesThatLeadFarAway) {
    auto told = lap();
    told.back().x_m = 1e6;
    EXPECT_THROW((void)tools::map_of(tools::read_drive(log(lap(), told), ""), 0.05),
                 tools::WrongInput);
}

}  // namespace
}  // namespace scipd::tests
