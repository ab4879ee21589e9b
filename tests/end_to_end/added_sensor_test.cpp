// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Sensors come and go by the control API while a driver of another one streams. What was changed
// in the world and of that scanner stays.
#include <cstdint>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/child.h"
#include "tests/support/control_request.h"

namespace scipd::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const json left{{"name", "r/left"},
                {"model", "URG-04LX"},
                {"tcp", "127.0.0.1:0"},
                {"accuracy", "ideal"},
                {"mount", {{"xyz", {0, 0, 0.3}}}}};
/// With its face 1 m ahead of the robots.
const std::string box =
    "<model name='crate'><link name='l'><visual name='v'><geometry><box><size>1 1 1</size></box>"
    "</geometry></visual></link></model>";

class AddedSensor : public testing::Test {
  protected:
    AddedSensor() {
        EXPECT_EQ(ask("PATCH", "/sensors/r/s", {{"noise", 0}, {"bias", "none"}}).status, 200);
        EXPECT_EQ(wire_.ask(stream_of_one_beam), "00");
        stamp_ms_ = wire_.next_scan().stamp_ms;
    }

    [[nodiscard]] ControlAnswer ask(const std::string& method, const std::string& path,
                                    const json& body = {}) const {
        return control_request(daemon_.control(), method, path, body.dump());
    }
    /// The port of the sensor that was added.
    std::uint16_t add(const json& sensor) const {
        const ControlAnswer answer = ask("POST", "/sensors", sensor);
        EXPECT_EQ(answer.status, 201) << answer.body;
        return port_of(json::parse(answer.body)["sensor"]["tcp"]);
    }
    /// Why it is not added.
    [[nodiscard]] std::string refusal(json changes, int status = 400) const {
        json sensor = left;
        sensor.update(changes);
        const ControlAnswer answer = ask("POST", "/sensors", sensor);
        EXPECT_EQ(answer.status, status) << answer.body;
        return answer.body;
    }
    /// The driver has missed no turn; returns what the beam ahead read last.
    std::uint32_t stream_goes_on() {
        std::uint32_t ahead_mm = 0;
        for (int i = 0; i < 8; ++i) {
            const auto scan = wire_.next_scan();
            EXPECT_EQ(turns_between(stamp_ms_, scan.stamp_ms), 1);
            stamp_ms_ = scan.stamp_ms;
            ahead_mm = scan.distances_mm.front();
        }
        return ahead_mm;
    }
    /// What the driver reads has waited for it, and so is of a while ago at first.
    bool streams_soon(std::uint32_t ahead_mm) {
        return eventually([&] { return stream_goes_on() == ahead_mm; });
    }
    static std::uint32_t ahead_mm(std::uint16_t port) {
        ScannerWire wire = ScannerWire::tcp(port);
        EXPECT_EQ(wire.ask("BM"), "00");
        wire.write("GD0384038400\n");
        return wire.next_scan().distances_mm.front();
    }

    TempDir directory_;
    DaemonProcess daemon_{
        directory_,
        {"--config",
         directory_.write("rig.yaml", "scene: " + scene("square_room.sdf").string() +
                                          "\nrobots: {r: {sensors: {s: {model: UST-10LX, mount: "
                                          "{xyz: [0, 0, 0.3]}, tcp: \"127.0.0.1:0\"}}}}\n")}};
    ScannerWire wire_{ScannerWire::tcp(daemon_.port())};
    std::uint32_t stamp_ms_ = 0;
};

TEST_F(AddedSensor, LooksAtTheWorldAsItIsByNow) {
    const json model{{"name", "crate"}, {"sdf", box}, {"pose", {{"xyz", {1.5, 0, 0.5}}}}};
    ASSERT_EQ(ask("POST", "/scene/models", model).status, 201);
    EXPECT_EQ(ahead_mm(add(left)), 1000U);
    EXPECT_TRUE(streams_soon(1000U));
    const json errors = control_get(daemon_.control(), "/sensors/r/s")["errors"];
    EXPECT_EQ(errors["noise"], 0.0);
    EXPECT_EQ(ask("DELETE", "/sensors/r/left").status, 204);
    EXPECT_EQ(ask("GET", "/sensors/r/left").status, 404);
    EXPECT_TRUE(streams_soon(1000U));
    EXPECT_EQ(ask("DELETE", "/sensors/r/s").status, 409);
}

// The robot has been moved before: it does not go back to where it began.
TEST_F(AddedSensor, LeavesARobotWhereItIs) {
    ASSERT_EQ(ask("PUT", "/robots/r/pose", {{"xyz", {1, 0, 0}}}).status, 204);
    EXPECT_EQ(ahead_mm(add(left)), 2000U);
    EXPECT_TRUE(streams_soon(2000U));
}

TEST_F(AddedSensor, BringsARobotThatIsGoneWithIt) {
    json sensor = left;
    sensor.update({{"name", "two/a"}, {"pose", {{"xyz", {-1, 0, 0}}}}});
    EXPECT_EQ(ahead_mm(add(sensor)), 4000U);
    const std::string told = ask("GET", "/configuration").body;
    EXPECT_THAT(told, HasSubstr("two:"));
    EXPECT_THAT(told, HasSubstr("model: URG-04LX"));
    const std::string saved = directory_.write("saved.yaml", told);
    directory_.write("world.sdf", ask("GET", "/scene/sdf").body);
    const Outcome check = run({SCIPD_PROGRAM, "--check", saved});
    EXPECT_EQ(check.exit_code, 0) << check.err;
    EXPECT_THAT(check.out + check.err, HasSubstr("robots: 2, sensors: 2"));
    EXPECT_EQ(ask("DELETE", "/sensors/two/a").status, 204);
    EXPECT_EQ(ask("GET", "/robots/two/pose").status, 404);
    EXPECT_EQ(ask("GET", "/configuration").body.find("two:"), std::string::npos);
    (void)stream_goes_on();
}

TEST_F(AddedSensor, IsRefusedWithWhatIsRight) {
    EXPECT_THAT(refusal({{"name", "left"}}), HasSubstr("ROBOT/SENSOR"));
    EXPECT_THAT(refusal({{"name", "r/a b"}}), HasSubstr("is no name"));
    EXPECT_THAT(refusal({{"name", "ä b/x"}}), HasSubstr(R"('\u00e4 b' is no name)"));
    EXPECT_THAT(refusal({{"name", "r/s"}}, 409), HasSubstr("already"));
    EXPECT_THAT(refusal({{"model", "URG-05LX"}}), HasSubstr("The models are URG-04LX"));
    EXPECT_THAT(refusal({{"nose", 2}}), HasSubstr("did you mean noise?"));
    EXPECT_THAT(refusal({{"tcp", "none"}}), HasSubstr("no driver could reach it"));
    EXPECT_THAT(refusal({{"pty", "/tmp/tty"}}, 403), HasSubstr("auto"));
    EXPECT_THAT(refusal({{"replay", {{"file", "/etc/hostname"}}}}, 403), HasSubstr("replay"));
    EXPECT_THAT(refusal({{"pose", {{"xyz", {1, 0, 0}}}}}, 409), HasSubstr("PUT /robots/r/pose"));
    const std::string port = "127.0.0.1:" + std::to_string(daemon_.port());
    EXPECT_THAT(refusal({{"tcp", port}}, 409), HasSubstr("cannot listen on " + port));
    (void)stream_goes_on();
    EXPECT_EQ(control_get(daemon_.control(), "/sensors").size(), 1U);
}

TEST_F(AddedSensor, ComesAndGoesByScipctl) {
    const auto scipctl = [&](const Arguments& words) {
        Arguments all{SCIPCTL, "--control", daemon_.control(), "sensor"};
        all.insert(all.end(), words.begin(), words.end());
        return run(all);
    };
    const Outcome added = scipctl({"add", "r/left", "model=URG-04LX", "tcp=127.0.0.1:0",
                                   "accuracy=ideal", "mount.xyz=[0, 0, 0.3]"});
    ASSERT_EQ(added.exit_code, 0) << added.err;
    EXPECT_EQ(ahead_mm(port_of(json::parse(added.out)["tcp"])), 3000U);
    EXPECT_THAT(scipctl({"add", "r/left", "model=URG-04LX"}).err, HasSubstr("already"));
    EXPECT_EQ(scipctl({"remove", "r/left"}).exit_code, 0);
    EXPECT_THAT(scipctl({"remove", "r/left"}).err, HasSubstr("r/s"));
}

}  // namespace
}  // namespace scipd::tests
