// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipd warns once about a scanner that is inside something or below the ground.
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/child.h"
#include "tests/support/control_request.h"

namespace scipd::tests {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

/// A ground, a crate at x 3, and a movable hull around the origin with an open top.
constexpr const char* yard = R"(<sdf version='1.9'><world name='yard'>
<model name='ground'><static>true</static><link name='l'><visual name='v'><geometry><plane>
<size>50 50</size></plane></geometry></visual></link></model>
<model name='crate'><static>true</static><pose>3 0 0.5 0 0 0</pose><link name='l'><visual name='v'>
<geometry><box><size>1 1 1</size></box></geometry></visual></link></model>
<model name='hull'><link name='l'>
<visual name='front'><pose>0.2 0 0.3 0 0 0</pose><geometry><box><size>0.01 0.4 0.2</size></box>
</geometry></visual>
<visual name='back'><pose>-0.2 0 0.3 0 0 0</pose><geometry><box><size>0.01 0.4 0.2</size></box>
</geometry></visual>
<visual name='left'><pose>0 0.2 0.3 0 0 0</pose><geometry><box><size>0.4 0.01 0.2</size></box>
</geometry></visual>
<visual name='right'><pose>0 -0.2 0.3 0 0 0</pose><geometry><box><size>0.4 0.01 0.2</size></box>
</geometry></visual></link></model></world></sdf>)";

class Place : public testing::Test {
  protected:
    /// Reads some scans of the first scanner.
    static void scan(const DaemonProcess& daemon) {
        auto wire = ScannerWire::tcp(daemon.port());
        EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
        for (int i = 0; i < 3; ++i)
            (void)wire.next_scan();
    }
    static std::string warning(const DaemonProcess& daemon) {
        const auto said = daemon.sensor_status().at("warning");
        return said.is_null() ? "" : said.get<std::string>();
    }
    static void put(const DaemonProcess& daemon, double x_m, double z_m = 0.0) {
        const nlohmann::json body{{"xyz", {x_m, 0.0, z_m}}};
        EXPECT_EQ(control_request(daemon.control(), "PUT", "/robots/r/pose", body.dump()).status,
                  204);
    }
    static std::size_t times(const std::string& text, const std::string& word) {
        std::size_t count = 0;
        for (auto found = text.find(word); found != text.npos; found = text.find(word, found + 1))
            ++count;
        return count;
    }
    std::string config(const std::string& of_robot, const std::string& world) {
        return directory_.write("rig.yaml", "scene: " + world + "\nrobots: {r: {" + of_robot +
                                                "sensors: {s: {model: UST-10LX, tcp: "
                                                "\"127.0.0.1:0\", mount: {xyz: [0, 0, 0.3]}}}}}");
    }

    TempDir directory_;
    const std::string yard_ = directory_.write("yard.sdf", yard);
};

TEST_F(Place, IsToldOnceInTheLogAndInTheStatus) {
    const DaemonProcess daemon(directory_, {"--config", config("pose: {xyz: [3, 0, 0]}, ", yard_)});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    EXPECT_EQ(warning(daemon), "") << "nobody has asked for a scan";
    scan(daemon);
    EXPECT_TRUE(eventually([&] { return !warning(daemon).empty(); }));
    EXPECT_THAT(warning(daemon), HasSubstr("is inside model crate (crate::l::v), which is solid"));
    EXPECT_THAT(warning(daemon), HasSubstr("if it is meant as a room"));
    EXPECT_THAT(run({SCIPCTL, "--control", daemon.control(), "status"}).out,
                HasSubstr("warning: r/s: is inside model crate"));
    put(daemon, 8);
    scan(daemon);
    EXPECT_TRUE(eventually([&] { return warning(daemon).empty(); }));
    put(daemon, 3);
    scan(daemon);
    EXPECT_TRUE(eventually([&] { return !warning(daemon).empty(); }));
    put(daemon, 8, -1);
    scan(daemon);
    EXPECT_TRUE(eventually([&] { return warning(daemon).starts_with("lies below the ground"); }));
    EXPECT_TRUE(eventually([&] {
        return times(daemon.standard_error(), "r/s: lies below the ground, model ground") == 1;
    }));
    EXPECT_EQ(times(daemon.standard_error(), "r/s: is inside model crate"), 1U)
        << daemon.standard_error();
}

TEST_F(Place, WithinARobotThatIsNotNamedSaysHowToNameIt) {
    const DaemonProcess nameless(directory_, {"--config", config("", yard_)});
    ASSERT_NE(nameless.ready_line(), "") << nameless.standard_error();
    scan(nameless);
    EXPECT_TRUE(eventually([&] { return !warning(nameless).empty(); }));
    EXPECT_THAT(warning(nameless), HasSubstr("is inside model hull"));
    EXPECT_THAT(warning(nameless), HasSubstr("name it as its body (body: hull)"));

    const TempDir other;
    const DaemonProcess named(other, {"--config", config("body: hull, ", yard_)});
    ASSERT_NE(named.ready_line(), "") << named.standard_error();
    scan(named);
    // scipd warns when a crate is put around the scanner. Then it has also checked everything
    // before.
    const nlohmann::json crate{{"name", "crate 2"},
                               {"sdf",
                                "<model name='m'><link name='l'><visual name='v'><geometry><box>"
                                "<size>1 1 1</size></box></geometry></visual></link></model>"}};
    EXPECT_EQ(control_request(named.control(), "POST", "/scene/models", crate.dump()).status, 201);
    scan(named);
    EXPECT_TRUE(eventually([&] { return !warning(named).empty(); }));
    EXPECT_THAT(warning(named), HasSubstr("crate 2"));
    EXPECT_THAT(named.standard_error(), Not(HasSubstr("hull")));
}

// Users who start the shipped examples read these warnings in the log.
TEST_F(Place, OfWhatIsShippedIsFine) {
    for (const char* file :
         {"demo.yaml", "two_robots.yaml", "beside_a_scanner.yaml", "materials_demo.yaml"}) {
        std::ifstream shipped{scene(file)};
        std::string text{std::istreambuf_iterator<char>{shipped}, {}};
        for (const std::string port : {":10940", ":10941", ":10942", ":14550"}) {
            for (auto at = text.find(port); at != text.npos; at = text.find(port, at))
                text.replace(at, port.size(), ":0");
        }
        for (auto at = text.find("scene: "); at != text.npos; at = text.npos)
            text.insert(at + 7, scene("").string() + "/");
        for (auto at = text.find("poses: rescue"); at != text.npos; at = text.npos)
            text.insert(at + 7, scene("").string() + "/");
        const TempDir other;
        const DaemonProcess daemon(other, {"--config", directory_.write("shipped.yaml", text)});
        ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
        const auto sensors = daemon.get("/sensors");
        for (const auto& sensor : sensors) {
            const std::string path = "/stream?sensor=" + sensor.at("name").get<std::string>();
            WebSocketClient stream(daemon.control(), path);
            (void)stream.receive();
        }
        // The loader works in order: when it answers this, it has checked the places.
        const nlohmann::json again{{"file", daemon.get("/scene").at("file")}};
        EXPECT_EQ(control_request(daemon.control(), "PUT", "/scene", again.dump()).status, 200);
        for (const auto& sensor : daemon.get("/sensors"))
            EXPECT_EQ(sensor.at("warning"), nullptr) << file;
        EXPECT_THAT(daemon.standard_error(),
                    Not(AnyOf(HasSubstr("is inside"), HasSubstr("below the ground"))))
            << file;
    }
}

}  // namespace
}  // namespace scipd::tests
