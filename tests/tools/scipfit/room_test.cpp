// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Rooms that are known come back from what a scanner sees of them.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>

#include "daemon/models/model_registry.h"
#include "tests/tools/scipfit/synthetic_scanner.h"
#include "tools/scipfit/room_report.h"

namespace scipd::tests {
namespace {

using testing::DoubleNear;
using testing::HasSubstr;
using tools::ScanTable;
using tools::Station;
using tools::Wall;

struct Seen {
    ScanTable readings;
    Station station;
    std::vector<Wall> walls;
};

Seen room_of(const Room& room, const Place& place, bool with_light = false) {
    daemon::Model model = daemon::find_model("UST-10LX");
    model.optics.bias = {{1.0, 0.0}};
    SyntheticScanner scanner(model, room, with_light, 4);
    Seen seen{.readings = scanner.begin(), .station = {}, .walls = {}};
    scanner.stand(place, 100, seen.readings);
    end_recording(seen.readings);
    seen.station = tools::stations_of(seen.readings).at(0);
    seen.walls = walls_of(seen.readings, seen.station);
    return seen;
}

// The scanner stands 0.5 m right of the middle and sees 270 degrees: not the wall behind it.
TEST(Room, HasItsWallsWhereTheyAre) {
    const Seen seen = room_of({}, {.x_m = 0.5});
    std::vector<double> distances;
    for (const Wall& wall : seen.walls) {
        distances.push_back(wall.distance_m);
        EXPECT_LT(wall.deviation_mm, 2.0);
    }
    ASSERT_GE(distances.size(), 3U);
    std::ranges::sort(distances);
    EXPECT_THAT(distances[0], DoubleNear(2.0, 0.002));
    EXPECT_THAT(distances[1], DoubleNear(2.0, 0.002));
    EXPECT_THAT(distances[2], DoubleNear(2.5, 0.002));
    const auto corner = std::ranges::find_if(
        seen.walls, [](const Wall& wall) { return std::abs(wall.distance_m - 2.5) < 0.01; });
    EXPECT_THAT(corner->begin.y_m, DoubleNear(-2.0, 0.005));
    EXPECT_THAT(corner->end.y_m, DoubleNear(2.0, 0.005));
}

// What beams see that look into a corner lies on a line across it.
TEST(Room, HasNoWallsAcrossItsCorners) {
    int corners = 0;
    for (const double yaw_rad : {0.2, 0.5, 0.9, 1.4}) {
        const Room room{.length_m = 8.2, .width_m = 6.0};
        const Seen seen = room_of(room, {.x_m = -0.9, .yaw_rad = yaw_rad}, true);
        for (std::size_t i = 1; i < seen.walls.size(); ++i) {
            const Wall& a = seen.walls[i - 1];
            const Wall& b = seen.walls[i];
            const double turn = std::abs(std::sin(a.normal_rad - b.normal_rad));
            EXPECT_TRUE(turn < 0.05 || turn > 0.99) << yaw_rad << ", beam " << b.first;
            if (turn < 0.5 || b.first > a.last + 10) continue;  // or hidden, or too dark
            ++corners;
            EXPECT_LT(std::hypot(b.begin.x_m - a.end.x_m, b.begin.y_m - a.end.y_m), 0.001);
        }
    }
    EXPECT_GE(corners, 8);
}

TEST(Room, ExplainsWhatIsSeen) {
    Room room;
    room.things = {{1.0, 1.2, 0.3}, {-0.5, -1.5, 0.2}};
    const Seen seen = room_of(room, {.x_m = -0.4, .yaw_rad = 0.4});
    const tools::RoomCheck check = check_room(seen.walls, seen.readings, seen.station);
    EXPECT_GT(check.beams, 1000U);
    EXPECT_GT(static_cast<double>(check.explained), 0.98 * static_cast<double>(check.beams));
    EXPECT_LT(check.rms_mm, 2.5);
}

TEST(Room, IsAWorldWithAWallForEach) {
    Seen seen = room_of({}, {});
    seen.readings.files = "a--b.mcap";
    std::ostringstream out;
    write_room({.walls = seen.walls, .check = {}, .stations = 1, .light = {}}, seen.readings,
               daemon::find_model("UST-10LX"), out);
    const std::string text = out.str();
    EXPECT_THAT(text, HasSubstr("a- b.mcap"));
    std::size_t models = 0;
    for (auto at = text.find("<model "); at != text.npos; at = text.find("<model ", at + 1))
        ++models;
    EXPECT_EQ(models, seen.walls.size());
}

/// The wall whose face is so far, and how bright it is.
double brightness_at(const Seen& seen, double distance_m) {
    const auto light = light_in(seen.walls, seen.readings, seen.station);
    for (std::size_t i = 0; light && i < seen.walls.size(); ++i) {
        if (std::abs(seen.walls[i].distance_m - distance_m) < 0.02) return light->brightness[i];
    }
    ADD_FAILURE() << "no wall at " << distance_m << " m";
    return 0.0;
}

// The front wall sends back 0.9 of the light, the left one 0.7 and the right one 0.3.
TEST(Room, TellsDarkWallsFromBrightOnes) {
    const Seen seen = room_of({}, {.x_m = 0.5, .y_m = 0.2}, true);
    EXPECT_NEAR(brightness_at(seen, 1.8) / brightness_at(seen, 2.5), 0.7 / 0.9, 0.01);
    EXPECT_NEAR(brightness_at(seen, 2.2) / brightness_at(seen, 2.5), 0.3 / 0.9, 0.01);
}

TEST(Room, HasNoBrightnessWithoutIntensities) {
    const Seen seen = room_of({}, {});
    EXPECT_FALSE(light_in(seen.walls, seen.readings, seen.station).has_value());
}

}  // namespace
}  // namespace scipd::tests
