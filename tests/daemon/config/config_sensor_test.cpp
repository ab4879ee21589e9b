// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How a device is found, its clock and its link: what they mean, and the literal words of every
// fault.
#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/config/config_fixture.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

/// FILE:LINE: and the key of the sensor, which is the same in all of these.
std::string at(const std::string& rest) {
    return "rig.yaml:3: robots.r.sensors.s." + rest;
}

using ConfigSensorTest = ConfigFixture;

TEST_F(ConfigSensorTest, AMountMayBeNamed) {
    const SensorConfig on_link = sensor("mount: {link: bot::base, xyz: [0, 0, 0.1]}");
    ASSERT_TRUE(on_link.mount);
    EXPECT_EQ(on_link.mount->kind, MountKind::link);
    EXPECT_EQ(on_link.mount->name, "bot::base");
    EXPECT_EQ(on_link.mount->frame_from_sensor.translation_m.z, 0.1);
    EXPECT_FALSE(on_link.mount->chooses_model);
    EXPECT_EQ(sensor("mount: {sensor: lds}").mount->kind, MountKind::sensor);
    EXPECT_FALSE(sensor("mount: {xyz: [0, 0, 0.1]}").mount);
    EXPECT_THAT(sensor_faults("mount: {sensor: lds, link: base}"),
                ElementsAre(HasSubstr("mount: give link or sensor, not both")));
    EXPECT_THAT(sensor_faults("mount: {sensor: ''}"), ElementsAre(HasSubstr("must name a place")));
    EXPECT_THAT(sensor_faults("mount: {lnk: base}"), ElementsAre(HasSubstr("did you mean link?")));
}

TEST_F(ConfigSensorTest, IsPoweredAndBootedWithAPerfectClockAndLinkWhereNothingIsSaid) {
    const SensorConfig plain = sensor("timing: real");
    EXPECT_EQ(plain.power_up, PowerUp::scip2);
    EXPECT_EQ(plain.clock, DeviceClockConfig{});
    EXPECT_EQ(plain.link, LinkConfig{});
}

TEST_F(ConfigSensorTest, IsFoundAsToldTo) {
    EXPECT_EQ(sensor("power_up: scip2.0").power_up, PowerUp::scip2);
    EXPECT_EQ(sensor("power_up: boot").power_up, PowerUp::boot);
    EXPECT_EQ(sensor("power_up: scip1.1", "URG-04LX").power_up, PowerUp::scip1);
    EXPECT_EQ(
        sensor("power_up: scip1.1, profile: {scip1: {firmware: 3.1.04}}", "UTM-30LX").power_up,
        PowerUp::scip1);

    EXPECT_THAT(sensor_faults("power_up: cold"),
                ElementsAre(at("power_up: must be scip2.0, scip1.1 or boot, not 'cold'")));
    EXPECT_THAT(sensor_faults("power_up: scip1.1"),
                ElementsAre(at("power_up: UST-10LX never spoke SCIP 1.1; use scip2.0 or boot")));
    EXPECT_THAT(sensor_faults("power_up: scip1.1, profile: {scip1: {firmware: \"\"}}", "URG-04LX"),
                ElementsAre(at("power_up: URG-04LX never spoke SCIP 1.1; use scip2.0 or boot")));
}

TEST_F(ConfigSensorTest, LooksBetweenThePixelsOfADepthBufferAsItIsTold) {
    EXPECT_EQ(sensor("backend: depth").depth, sim::DepthOptions{});
    EXPECT_EQ(sensor("depth: {}").depth, sim::DepthOptions{});
    const sim::DepthOptions depth =
        sensor(
            "backend: depth, depth: {between_pixels: nearest, oversample: 2.5, "
            "widest_pass_deg: 60}")
            .depth;
    EXPECT_EQ(depth.between_pixels, sim::BetweenPixels::nearest);
    EXPECT_EQ(depth.oversample, 2.5);
    EXPECT_DOUBLE_EQ(depth.widest_pass_rad, 1.0471975511965976);
    EXPECT_EQ(sensor("depth: {between_pixels: interpolate}").depth.between_pixels,
              sim::BetweenPixels::interpolate);
    EXPECT_EQ(sensor("backend: auto, depth: {between_pixels: exact, oversample: 1, "
                     "widest_pass_deg: 90}")
                  .depth,
              sim::DepthOptions{});
}

TEST_F(ConfigSensorTest, SaysWhatADepthBufferCannotBe) {
    EXPECT_THAT(
        sensor_faults("depth: {between_pixels: linear, oversample: 0.5, widest_pass_deg: 121, "
                      "pixels: 3}"),
        ElementsAre(at("depth.pixels: unknown key; known here are between_pixels, oversample, "
                       "widest_pass_deg"),
                    at("depth.between_pixels: must be nearest, interpolate or exact, not "
                       "'linear'"),
                    at("depth.oversample: must be 1 to 16, not '0.5'"),
                    at("depth.widest_pass_deg: must be 10 to 120 degrees, not '121'")));
    EXPECT_THAT(sensor_faults("depth: {oversample: 16.1, widest_pass_deg: wide}"),
                ElementsAre(at("depth.oversample: must be 1 to 16, not '16.1'"),
                            at("depth.widest_pass_deg: must be a number, not 'wide'")));
    EXPECT_THAT(sensor_faults("depth: {widest_pass_deg: 9.9}"),
                ElementsAre(at("depth.widest_pass_deg: must be 10 to 120 degrees, not '9.9'")));
    EXPECT_THAT(
        sensor_faults("depth: exact"),
        ElementsAre(at("depth: must be a map of keys and values, such as depth: {oversample: 2}")));
    EXPECT_THAT(sensor_faults("backend: embree, depth: {oversample: 2}"),
                ElementsAre(at("depth: is of a depth buffer, which backend embree has not; use "
                               "backend depth or auto, or leave it out")));
    EXPECT_THAT(sensor_faults("backend: reference, depth: {}"),
                ElementsAre(at("depth: is of a depth buffer, which backend reference has not; "
                               "use backend depth or auto, or leave it out")));
}

TEST_F(ConfigSensorTest, HasAClockThatRunsAsItLikes) {
    const DeviceClockConfig clock = sensor("clock: {ppm: -49.5, start_ms: 16777215}").clock;
    EXPECT_EQ(clock.ppm, -49.5);
    EXPECT_EQ(clock.start_ms, 16777215u);
    EXPECT_EQ(sensor("clock: {ppm: 10000}").clock, (DeviceClockConfig{.ppm = 10000.0}));

    EXPECT_THAT(
        sensor_faults("clock: {ppm: 10001, start_ms: 16777216, drift: 1}"),
        ElementsAre(
            at("clock.drift: unknown key; known here are ppm, start_ms, phase_ms"),
            at("clock.ppm: must lie within 10000 ppm, not '10001'"),
            at("clock.start_ms: must be a whole number from 0 to 16777215, not '16777216'")));
    EXPECT_THAT(sensor_faults("clock: {ppm: fast, start_ms: -1}"),
                ElementsAre(at("clock.ppm: must be a number, not 'fast'"),
                            at("clock.start_ms: must be a whole number from 0 to 16777215, not "
                               "'-1'")));
    EXPECT_EQ(sensor("clock: {}").clock.phase, std::nullopt);
    EXPECT_EQ(sensor("clock: {phase_ms: 12.5}").clock.phase, 12500us);
    EXPECT_THAT(sensor_faults("clock: {phase_ms: 1001}"),
                ElementsAre(at("clock.phase_ms: must be 0 to 1000 ms, not '1001'")));
    EXPECT_THAT(
        sensor_faults("clock: 50"),
        ElementsAre(at("clock: must be a map of keys and values, such as clock: {ppm: 20}")));
}

TEST_F(ConfigSensorTest, HasALinkWithTroublesOfItsOwn) {
    const LinkConfig link =
        sensor(
            "tcp: 127.0.0.1:0, link: {latency_ms: 0.5, jitter_ms: 0.1, baud: 750000, "
            "split_bytes: 7, coalesce_ms: 2, on_close: keep, dead_after_s: 2.5}",
            "URG-04LX")
            .link;
    EXPECT_EQ(link.latency, 500us);
    EXPECT_EQ(link.jitter, 100us);
    EXPECT_EQ(link.baud, 750000);
    EXPECT_EQ(link.split_bytes, 7);
    EXPECT_EQ(link.coalesce, 2ms);
    EXPECT_FALSE(link.stop_on_close);
    EXPECT_EQ(link.dead_after, 2500ms);
    EXPECT_TRUE(sensor("link: {on_close: stop}").link.stop_on_close);
    EXPECT_TRUE(sensor("").link.stop_on_close);
    EXPECT_EQ(sensor("").link.dead_after, 30s);
    EXPECT_EQ(sensor("tcp: 127.0.0.1:0, link: {dead_after_s: 0}").link.dead_after, 0s);
    EXPECT_EQ(sensor("link: {latency_ms: 10000, jitter_ms: 10000}").link.jitter, 10s);
}

TEST_F(ConfigSensorTest, SaysWhatALinkCannotBe) {
    EXPECT_THAT(
        sensor_faults("tcp: 127.0.0.1:0, link: {latency_ms: -1, jitter_ms: 1e9, baud: 9.6, "
                      "split_bytes: 65537, "
                      "coalesce_ms: nan, on_close: hang, dead_after_s: 0.5, delay: 1}",
                      "URG-04LX"),
        ElementsAre(at("link.delay: unknown key; known here are latency_ms, jitter_ms, baud, "
                       "split_bytes, coalesce_ms, on_close, dead_after_s"),
                    at("link.latency_ms: must be 0 to 10000 ms, not '-1'"),
                    at("link.jitter_ms: must be 0 to 10000 ms, not '1e9'"),
                    at("link.baud: must be a whole number from 300 to 999999, not '9.6'"),
                    at("link.split_bytes: must be a whole number from 0 to 65536, not '65537'"),
                    at("link.coalesce_ms: must be a number, not 'nan'"),
                    at("link.on_close: must be keep or stop, not 'hang'"),
                    at("link.dead_after_s: must be 1 to 3600 s, or 0 for never, not '0.5'")));
    EXPECT_THAT(sensor_faults("link: {latency_ms: 1, jitter_ms: 1.5}"),
                ElementsAre(at("link.jitter_ms: must not exceed latency_ms: nothing arrives before "
                               "it is sent")));
    EXPECT_THAT(sensor_faults("link: {baud: 9600}", "URG-04LX"),
                ElementsAre(at("link.baud: URG-04LX has no such rate; use one of 19200, 38400, "
                               "57600, 115200, 250000, 500000, 750000")));
    EXPECT_THAT(sensor_faults("link: {baud: 19200}"),
                ElementsAre(at("link.baud: UST-10LX has no serial line; leave it out")));
    EXPECT_THAT(faults("scene: room.sdf\n"
                       "robots: {r: {sensors: {s: {model: URG-04LX, tcp: 127.0.0.1:0, pty: none,\n"
                       "link: {baud: 19200, on_close: keep}}}}}\n"),
                ElementsAre(at("link.baud: is of a tty; give pty, or leave it out"),
                            at("link.on_close: is of a tty; give pty, or leave it out")));
    EXPECT_THAT(faults("scene: room.sdf\n"
                       "robots: {r: {sensors: {s: {model: URG-04LX, pty: auto,\n"
                       "link: {dead_after_s: 5}}}}}\n"),
                ElementsAre(at("link.dead_after_s: is of TCP; give tcp, or leave it out")));
}

TEST_F(ConfigSensorTest, PacesTheRatesThatAProfileAdds) {
    EXPECT_EQ(sensor("link: {baud: 9600}, profile: {bit_rates: [9600]}", "UTM-30LX").link.baud,
              9600);
}

}  // namespace
}  // namespace scipd::daemon
