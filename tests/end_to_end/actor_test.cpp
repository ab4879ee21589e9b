// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The person who crosses the room of scenes/crossing.sdf at 1 m/s, as clients see her.
#include <cmath>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/control_request.h"
#include "tests/support/daemon_process.h"
#include "tests/support/scanner_wire.h"

namespace scipd::tests {
namespace {

using namespace std::chrono_literals;

Arguments crossing(Arguments more) {
    Arguments arguments{"--scene",    scene("crossing.sdf"),
                        "--mount",    "0,0,0.3,0,0,0",
                        "--accuracy", "ideal",
                        "--pty",      "none",
                        "--tcp",      "127.0.0.1:0"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

/// The range ahead of the origin. She walks along x = 1.5, but the axis of a leg is 0.1 m nearer.
double ahead_m(double person_y_m) {
    constexpr double radius_m = 0.07;
    if (std::abs(person_y_m) >= radius_m) return 3.0;
    return 1.4 - std::sqrt(radius_m * radius_m - person_y_m * person_y_m);
}

/// Her y this long after the world was loaded, where she walks at constant speed; else NaN.
double person_y_m(double time_s) {
    const double lap_s = std::fmod(time_s, 6.0);
    if (lap_s > 0.6 && lap_s < 1.8) return lap_s - 1.2;
    if (lap_s > 3.6 && lap_s < 4.8) return 4.2 - lap_s;
    return std::nan("");
}

TEST(Actors, AreMetWhereTheirScriptHasThem) {
    const TempDir directory;
    const DaemonProcess daemon(directory, crossing({"--clock", "poses", "--poses", "-"}));
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    for (int i = 0; i <= 660; ++i)
        daemon.say(R"({"xyz":[0,0,0],"t":)" + std::to_string(500.0 + i / 50.0) + "}\n");
    int met = 0;
    int missed = 0;
    for (int i = 0; i < 500; ++i) {
        const auto scan = wire.next_scan();
        // The time at which the beam ahead is fired, in a turn of 25 ms that begins with step 0.
        const double y_m = person_y_m(1e-3 * scan.stamp_ms + 0.025 * 540 / 1440);
        // At the edge of a leg a millisecond matters, so such scans are skipped.
        if (std::isnan(y_m) || (std::abs(y_m) > 0.05 && std::abs(y_m) < 0.09)) continue;
        ++(std::abs(y_m) < 0.07 ? met : missed);
        EXPECT_NEAR(scan.distances_mm.front(), 1000.0 * ahead_m(y_m), 4.0) << scan.stamp_ms;
    }
    EXPECT_GE(met, 3 * 4);  // twice there and twice back
    EXPECT_GE(missed, 100);
}

TEST(Actors, AreModelsThatTheUserMayTakeOver) {
    const TempDir directory;
    const DaemonProcess daemon(directory, crossing({}));
    const auto y_m = [&] {
        return daemon.get("/scene/models/person/pose").at("xyz").at(1).get<double>();
    };
    const double before_m = y_m();
    EXPECT_TRUE(eventually([&] { return std::abs(y_m() - before_m) > 0.3; }));
    EXPECT_EQ(control_request(daemon.control(), "PUT", "/scene/models/person/pose",
                              R"({"xyz":[-1,0.5,0]})")
                  .status,
              204);
    const auto taken = daemon.get("/scene").at("models");
    EXPECT_EQ(taken.at(1).at("name"), "person");
    EXPECT_EQ(taken.at(1).at("movable"), true);
    EXPECT_EQ(y_m(), 0.5);
    std::this_thread::sleep_for(100ms);
    EXPECT_EQ(y_m(), 0.5);
    // She begins anew, because the world is loaded anew.
    EXPECT_EQ(control_request(daemon.control(), "PUT", "/scene",
                              R"({"file":")" + scene("crossing.sdf").string() + R"("})")
                  .status,
              200);
    EXPECT_LT(y_m(), 0.5);
    EXPECT_TRUE(eventually([&] { return y_m() > 0.6; }));
}

}  // namespace
}  // namespace scipd::tests
