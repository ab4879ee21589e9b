// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Cameras and rangers in a configuration: what is said of them, and the literal words of every
// fault.
#include <chrono>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/config/config_fixture.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double radians(double angle_deg) {
    return angle_deg * std::numbers::pi / 180.0;
}

const std::string tof =
    "camera: {columns: 176, rows: 144, fov_deg: [43.6, 34.6], rate_hz: 25, range_m: [0.1, 7.5]}";
const std::string sonar = "ranger: {cone_deg: 30, beams: 61, rate_hz: 20, range_m: [0.02, 4.0]}";

/// FILE:LINE: and the key of the sensor, which is the same in all of these.
std::string at(const std::string& rest) {
    return "rig.yaml:3: robots.r.sensors.s" + rest;
}

class ConfigStaringTest : public ConfigFixture {
  protected:
    static std::string of(const std::string& keys) {
        return "scene: room.sdf\nrobots: {r: {sensors: {\ns: {" + keys + "}}}}\n";
    }
    SensorConfig sensor(const std::string& keys) const {
        return parse(of(keys)).robots.at(0).sensors.at(0);
    }
    sim::StaringSpec spec(const std::string& keys) const { return sensor(keys).staring.value(); }
    std::vector<std::string> faults(const std::string& keys) const {
        return ConfigFixture::faults(of(keys));
    }
};

TEST_F(ConfigStaringTest, ACameraIsAPinholeAndOneInstant) {
    const SensorConfig config = sensor(tof);
    EXPECT_EQ(config.motion, 1);
    EXPECT_FALSE(config.tcp || config.pty);
    const auto expected =
        sim::StaringSpec{.optics = sim::PinholeGrid{176, 144, radians(43.6), radians(34.6)},
                         .period = 40ms,
                         .min_range_m = 0.1,
                         .max_range_m = 7.5,
                         .noise = {}};
    EXPECT_EQ(config.staring, expected);
    EXPECT_EQ(expected.kind(), "camera");
    EXPECT_EQ(expected.beams(), 176 * 144);
}

TEST_F(ConfigStaringTest, ARangerIsACone) {
    const auto optics = [&](const std::string& keys) {
        return std::get<sim::RangerOptics>(spec(keys).optics);
    };
    EXPECT_EQ(optics(sonar), (sim::RangerOptics{{radians(30), 61}, sim::Aggregate::nearest}));
    EXPECT_EQ(optics("ranger: {cone_deg: 180, beams: 1, rate_hz: 1, range_m: [0, 1], aggregate: "
                     "weighted}"),
              (sim::RangerOptics{{radians(180), 1}, sim::Aggregate::weighted}));
    EXPECT_EQ(spec(sonar).period, 50ms);
    EXPECT_EQ(spec(sonar).kind(), "ranger");
}

TEST_F(ConfigStaringTest, HaveWhatAllSensorsHave) {
    const SensorConfig config =
        sensor(tof +
               ", mount: {xyz: [0.2, 0, 0.3]}, backend: reference, accuracy: ideal, motion: beam, "
               "sees_body: true");
    EXPECT_EQ(config.robot_from_sensor.translation_m, glm::dvec3(0.2, 0, 0.3));
    EXPECT_EQ(config.backend, "reference");
    EXPECT_EQ(config.accuracy, sim::Accuracy::ideal);
    EXPECT_FALSE(config.motion);
    EXPECT_TRUE(config.sees_body);
    EXPECT_THAT(faults(tof + ", accuracy: material"), ElementsAre(HasSubstr("s.accuracy: ")));
}

TEST_F(ConfigStaringTest, MayBeNoisy) {
    const std::string rest = "beams: 61, rate_hz: 20, range_m: [0.02, 4.0], noise: ";
    EXPECT_THAT(spec("ranger: {cone_deg: 30, " + rest + "{sigma_m: 0.01, share: 0.002}}").noise,
                ElementsAre(sim::NoiseStep{0.0, 0.01, 0.002}));
    EXPECT_THAT(spec("ranger: {cone_deg: 30, " + rest + "{sigma_m: 0}}").noise, IsEmpty());
    EXPECT_THAT(faults("ranger: {cone_deg: 30, " + rest + "{sigma_m: -1, share: 2, from_m: 1}}"),
                ElementsAre(at(".ranger.noise.from_m: unknown key; known here are sigma_m, share"),
                            at(".ranger.noise.sigma_m: must be 0 or more, not '-1'"),
                            at(".ranger.noise.share: must be 0 to 1, not '2'")));
}

TEST_F(ConfigStaringTest, SaysWhatTheyCannotBe) {
    EXPECT_THAT(
        faults("camera: {columns: 0, rows: 1000001, fov_deg: [180, 10], rate_hz: 0.5, range_m: "
               "[7.5, 0.1]}"),
        ElementsAre(at(".camera.columns: must be a whole number from 1 to 307200, not '0'"),
                    at(".camera.rows: must be a whole number from 1 to 307200, not '1000001'"),
                    at(".camera.fov_deg: must be more than 0 and up to 170 degrees, not '180'"),
                    at(".camera.rate_hz: must be 1 to 1000 Hz, not '0.5'"),
                    at(".camera.range_m: must be [NEAREST, FARTHEST] in metres, such as [0.1, "
                       "7.5]")));
    EXPECT_THAT(faults("camera: {columns: 1001, rows: 1000, fov_deg: 40, rate_hz: fast, range_m: "
                       "[0]}"),
                ElementsAre(at(".camera: columns times rows must not exceed 307200"),
                            at(".camera.fov_deg: must be a list of two numbers, such as [1, 2]"),
                            at(".camera.rate_hz: must be a number, not 'fast'"),
                            at(".camera.range_m: must be a list of two numbers, such as [1, 2]")));
    EXPECT_THAT(faults("ranger: {cone_deg: 181, beams: 100001, aggregate: mean, rate_hz: 1001, "
                       "range_m: [-1, 4]}"),
                ElementsAre(at(".ranger.cone_deg: must be more than 0 and up to 180 degrees, not "
                               "'181'"),
                            at(".ranger.beams: must be a whole number from 1 to 100000, not "
                               "'100001'"),
                            at(".ranger.aggregate: must be nearest or weighted, not 'mean'"),
                            at(".ranger.rate_hz: must be 1 to 1000 Hz, not '1001'"),
                            at(".ranger.range_m: must be 0 or more, not '-1'")));
}

TEST_F(ConfigStaringTest, SaysWhatIsMissing) {
    EXPECT_THAT(faults("camera: {}"),
                ElementsAre(at(".camera: needs columns"), at(".camera: needs rows"),
                            at(".camera: needs fov_deg"), at(".camera: needs rate_hz"),
                            at(".camera: needs range_m")));
    EXPECT_THAT(faults("ranger: 30"),
                ElementsAre(at(".ranger: must be a map of keys and values; known here are "
                               "cone_deg, beams, aggregate, rate_hz, range_m, noise")));
    EXPECT_THAT(faults("ranger: {beams: 61}"),
                ElementsAre(at(".ranger: needs cone_deg"), at(".ranger: needs rate_hz"),
                            at(".ranger: needs range_m")));
    EXPECT_THAT(faults("pty: auto"),
                ElementsAre(at(": needs a model, a camera or a ranger; `scipd --list-models` lists "
                               "them")));
}

TEST_F(ConfigStaringTest, AreOneThingAndHaveNoWire) {
    EXPECT_THAT(faults(tof + ", model: UST-10LX"),
                ElementsAre(at(".model: is of a scanner; give model, camera or ranger, and leave "
                               "the others out")));
    EXPECT_THAT(faults(tof + ", " + sonar),
                ElementsAre(at(".ranger: there is a camera already; give one of the two")));
    const std::string no_wire =
        ": is of scanners, which speak SCIP; a camera or ranger is read through the control API: "
        "leave it out";
    EXPECT_THAT(faults(sonar + ", tcp: 127.0.0.1:0, pty: auto, timing: real, power_up: boot, "
                               "clock: {ppm: 1}, link: {latency_ms: 1}, profile: {serial: X}"),
                ElementsAre(at(".tcp" + no_wire), at(".pty" + no_wire), at(".timing" + no_wire),
                            at(".power_up" + no_wire), at(".clock" + no_wire),
                            at(".link" + no_wire), at(".profile" + no_wire)));
}

}  // namespace
}  // namespace scipd::daemon
