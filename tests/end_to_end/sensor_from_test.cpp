// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Scanners at the places that a world names. Their ranges have a closed form, in a room whose walls
// are along the axes.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/backend_names.h"
#include "tests/support/control_request.h"

namespace scipd::tests {
namespace {

using testing::HasSubstr;

struct Eye {
    double x_m;
    double y_m;
    double yaw_rad;
};

constexpr double left = std::numbers::pi / 2;

/// The bearing of a step of a UST-10LX: 1081 beams, a quarter of a degree apart.
double bearing_rad(std::size_t step) {
    return (static_cast<double>(step) - 540.0) * std::numbers::pi / 720.0;
}

/// The range to the inner faces of the room: x from -4 to 6, y from -3 to 5.
double range_m(const Eye& eye, std::size_t step) {
    const double angle = eye.yaw_rad + bearing_rad(step);
    const double dx = std::cos(angle);
    const double dy = std::sin(angle);
    const auto to = [](double from, double low, double high, double along) {
        if (std::abs(along) < 1e-9) return std::numeric_limits<double>::infinity();
        return ((along > 0 ? high : low) - from) / along;
    };
    return std::min(to(eye.x_m, -4, 6, dx), to(eye.y_m, -3, 5, dy));
}

std::string wall(const std::string& name, const std::string& pose, const std::string& size) {
    return "<visual name='" + name + "'><pose>" + pose + "</pose><geometry><box><size>" + size +
           "</size></box></geometry></visual>";
}

std::string lidar(const std::string& name, const std::string& pose, int samples = 1081) {
    return "<sensor name='" + name + "' type='gpu_lidar'><pose>" + pose +
           "</pose><update_rate>40</update_rate><lidar><scan><horizontal><samples>" +
           std::to_string(samples) +
           "</samples><min_angle>-2.35619</min_angle><max_angle>2.35619</max_angle></horizontal>"
           "</scan><range><min>0.02</min><max>30</max></range></lidar></sensor>";
}

/// A robot with a housing around its lidar, which stands at x 1, y 1 and looks to the left. A
/// second lidar looks back from a fixed post.
std::string world(const std::string& lidar_pose = "0.2 0 0 0 0 0") {
    return "<sdf version='1.9'><world name='w'><model name='room'><static>true</static>"
           "<link name='walls'>" +
           wall("e", "6.5 0 1 0 0 0", "1 20 4") + wall("w", "-4.5 0 1 0 0 0", "1 20 4") +
           wall("n", "0 5.5 1 0 0 0", "20 1 4") + wall("s", "0 -3.5 1 0 0 0", "20 1 4") +
           "</link><link name='post'><pose>-2 0 1 0 0 3.141592653589793</pose>" +
           lidar("watch", "0.5 0 0 0 0 0") +
           "</link></model><model name='bot'><pose>1 1 0 0 0 1.5707963267948966</pose>"
           "<frame name='mast' attached_to='base'><pose>0 0.5 0 0 0 0</pose></frame>"
           "<link name='base'><pose>0 0 0.3 0 0 0</pose>" +
           wall("v", "0 0 0 0 0 0", "0.8 0.8 0.8") + lidar("lds", lidar_pose) +
           lidar("fine", "0 0 0 0 0 0", 2161) + "</link></model></world></sdf>";
}

class SensorFrom : public testing::Test {
  protected:
    Arguments in_world(Arguments more) {
        Arguments arguments{"--scene",    directory_.write("w.sdf", world()),
                            "--accuracy", "ideal",
                            "--tcp",      "127.0.0.1:0",
                            "--pty",      "none"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    static std::vector<std::uint32_t> scan(const DaemonProcess& daemon) {
        ScannerWire wire = ScannerWire::tcp(daemon.port());
        EXPECT_EQ(wire.ask(stream_of_all_beams), "00");
        // The first scan may have begun earlier.
        (void)wire.next_scan();
        (void)wire.next_scan();
        return wire.next_scan().distances_mm;
    }

    static void expect_seen_from(const DaemonProcess& daemon, const Eye& eye) {
        const auto ranges_mm = scan(daemon);
        ASSERT_EQ(ranges_mm.size(), 1081U);
        for (std::size_t step = 0; step < ranges_mm.size(); ++step)
            EXPECT_NEAR(ranges_mm[step], 1000 * range_m(eye, step), 1.5) << step;
    }

    static void expect_said(const DaemonProcess& daemon, const std::string& text) {
        EXPECT_TRUE(eventually([&] {
            return daemon.standard_error().find(text) != std::string::npos;
        })) << daemon.standard_error();
    }

    TempDir directory_;
};

class SensorFromByBackend : public SensorFrom, public testing::WithParamInterface<std::string> {};

// It looks out of the housing, which is its own body.
TEST_P(SensorFromByBackend, SeesTheWorldFromWhereTheFileHasIt) {
    const bool draws = GetParam() == sim::drawing_backend().name;
    if (draws && !can_draw()) GTEST_SKIP() << "nothing to draw with";
    DaemonProcess daemon(directory_,
                         in_world({"--sensor-from", "bot::base::lds", "--backend", GetParam()}));
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    expect_seen_from(daemon, {1.0, 1.2, left});
    expect_said(daemon, "UST-10LX fits bot::base::lds best\n");
}

INSTANTIATE_TEST_SUITE_P(By, SensorFromByBackend, testing::ValuesIn(backend_names()),
                         [](const auto& backend) { return backend.param; });

TEST_F(SensorFrom, IsTheProductThatFitsBestUnlessOneIsNamed) {
    DaemonProcess best(directory_, in_world({"--sensor-from", "fine"}));
    EXPECT_THAT(best.ready_line(), HasSubstr(R"("model":"UST-10LX-H01")"));
    DaemonProcess named(directory_,
                        in_world({"--sensor-from", "base::fine", "--model", "UST-10LX"}));
    EXPECT_THAT(named.ready_line(), HasSubstr(R"("model":"UST-10LX")"));
    expect_said(named, "UST-10LX-H01 would fit bot::base::fine better than UST-10LX");
    expect_seen_from(named, {1.0, 1.0, left});
}

TEST_F(SensorFrom, OfAModelThatDoesNotMoveToo) {
    DaemonProcess daemon(directory_, in_world({"--sensor-from", "watch"}));
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    const auto ranges_mm = scan(daemon);
    // Checks the beams to the back and the right, where the robot is not in the way.
    for (std::size_t step = 180; step < 900; ++step)
        EXPECT_NEAR(ranges_mm[step], 1000 * range_m({-2.5, 0, 2 * left}, step), 1.5) << step;
}

TEST_F(SensorFrom, AFrameIsAMountAsWell) {
    DaemonProcess daemon(directory_, in_world({"--mount", "bot::mast"}));
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    expect_seen_from(daemon, {0.5, 1.0, left});
}

TEST_F(SensorFrom, TellsWhatThereIs) {
    DaemonProcess daemon(directory_, in_world({"--sensor-from", "bot::lds"}));
    EXPECT_EQ(daemon.wait(), 2);
    EXPECT_THAT(daemon.standard_error(),
                HasSubstr("w.sdf has no lidar \"bot::lds\"; there are: room::post::watch, "
                          "bot::base::lds, bot::base::fine\n"));
}

class NamedMounts : public SensorFrom {
  protected:
    std::string configuration(const std::string& mount) {
        return directory_.write("rig.yaml",
                                "scene: " + directory_.write("w.sdf", world()).string() +
                                    "\nrobots:\n  rescue:\n    sensors:\n      front:\n"
                                    "        model: UST-10LX\n        accuracy: ideal\n"
                                    "        tcp: 127.0.0.1:0\n        mount: " +
                                    mount + "\n");
    }
    static ControlAnswer load(const DaemonProcess& daemon, const std::string& file) {
        return control_request(daemon.control(), "PUT", "/scene",
                               nlohmann::json{{"file", file}}.dump());
    }
};

TEST_F(NamedMounts, MoveWithTheirModel) {
    DaemonProcess daemon(directory_,
                         {"--config", configuration("{sensor: lds, xyz: [-0.2, 0, 0]}")});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    expect_seen_from(daemon, {1.0, 1.0, left});
    const auto moved = control_request(daemon.control(), "PUT", "/robots/rescue/pose",
                                       R"({"xyz":[3,-1,0],"rpy":[0,0,0]})");
    EXPECT_EQ(moved.status, 204) << moved.body;
    expect_seen_from(daemon, {3.0, -1.0, 0.0});
    const auto scene = daemon.get("/scene");
    const auto& sensors = scene.at("sensors");
    const auto lds = std::ranges::find(sensors, "bot::base::lds", [](const auto& s) {
        return s.at("name").template get<std::string>();
    });
    ASSERT_NE(lds, sensors.end());
    EXPECT_NEAR(lds->at("pose").at("xyz").at(0).get<double>(), 3.2, 1e-9);
    EXPECT_EQ(lds->at("fits"), "UST-10LX");
}

TEST_F(NamedMounts, AreFoundAgainInAnotherWorld) {
    DaemonProcess daemon(directory_, {"--config", configuration("{sensor: lds}")});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    expect_seen_from(daemon, {1.0, 1.2, left});
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    EXPECT_EQ(wire.ask("VV"), "00");

    const auto other =
        load(daemon, directory_.write("other.sdf", world("0 0 0 0 0 -1.5707963267948966")));
    EXPECT_EQ(other.status, 200);
    EXPECT_EQ(nlohmann::json::parse(other.body).at("warnings"), nlohmann::json::array());
    wire.close();
    expect_seen_from(daemon, {1.0, 1.0, 0.0});

    std::string without = world();
    without.replace(without.find("'lds'"), 5, "'sdl'");
    const auto lost = load(daemon, directory_.write("third.sdf", without));
    EXPECT_EQ(lost.status, 200);
    EXPECT_THAT(lost.body, HasSubstr("to mount rescue/front on; it stays where it was"));
    expect_seen_from(daemon, {1.0, 1.0, 0.0});

    // Loads the configuration's own world again. The same scanner is back in its place.
    const auto scans = daemon.sensor_status().at("scans").get<int>();
    daemon.signal(SIGHUP);
    expect_said(daemon, "is running now");
    EXPECT_GE(daemon.sensor_status().at("scans").get<int>(), scans);
    expect_seen_from(daemon, {1.0, 1.2, left});
}

TEST_F(NamedMounts, AreCheckedWithTheirLine) {
    DaemonProcess wrong(directory_, {"--check", configuration("{link: bot::lid}")});
    EXPECT_EQ(wrong.wait(), 2);
    EXPECT_THAT(wrong.standard_error(),
                HasSubstr("rig.yaml:9: robots.rescue.sensors.front.mount: "));
    EXPECT_THAT(wrong.standard_error(), HasSubstr("has no link or frame \"bot::lid\""));
    DaemonProcess right(directory_, {"--check", configuration("{sensor: fine}")});
    EXPECT_EQ(right.wait(), 0);
    EXPECT_THAT(right.standard_output(),
                HasSubstr("UST-10LX-H01 would fit bot::base::fine better than UST-10LX"));
}

}  // namespace
}  // namespace scipd::tests
