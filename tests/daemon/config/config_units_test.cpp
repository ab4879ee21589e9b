// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Numbers of a configuration that look to be in another unit.
#include <gmock/gmock.h>

#include "tests/daemon/config/config_fixture.h"

namespace scipd::daemon {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class ConfigUnits : public ConfigFixture {
  protected:
    /// Without the folder, which differs from run to run.
    std::vector<std::string> warnings(const std::string& text) const {
        std::vector<std::string> warnings = parse(text).warnings;
        for (std::string& warning : warnings)
            warning.erase(0, (dir_.path() / "").string().size());
        return warnings;
    }
};

TEST_F(ConfigUnits, DegreesAreToldOfRobotsAndMounts) {
    EXPECT_THAT(warnings("scene: room.sdf\n"
                         "robots:\n"
                         "  r:\n"
                         "    pose: {rpy: [0, 0, 90]}\n"
                         "    sensors:\n"
                         "      s: {model: UST-10LX, pty: auto, mount: {rpy: [180, 0, 0]}}\n"
                         "      c: {camera: {columns: 8, rows: 6, fov_deg: [40, 30], rate_hz: 25, "
                         "range_m: [100, 7500]},\n"
                         "          mount: {rpy: [0, 45, 0]}}\n"),
                ElementsAre("rig.yaml:4: robots.r.pose.rpy: 0, 0, 90 looks like degrees, but "
                            "angles are radians; did you mean 0, 0, 1.5708?",
                            "rig.yaml:6: robots.r.sensors.s.mount.rpy: 180, 0, 0 looks like "
                            "degrees, but angles are radians; did you mean 3.1416, 0, 0?",
                            "rig.yaml:8: robots.r.sensors.c.mount.rpy: 0, 45, 0 looks like "
                            "degrees, but angles are radians; did you mean 0, 0.7854, 0?",
                            "rig.yaml:7: robots.r.sensors.c.camera.range_m: 100, 7500 looks like "
                            "millimetres, but lengths are metres; did you mean 0.1, 7.5?"));
}

TEST_F(ConfigUnits, MillimetresAreToldOfTheWallsOfAMap) {
    const std::string robots = "robots: {r: {sensors: {s: {model: UST-10LX, pty: auto}}}}\n";
    EXPECT_THAT(warnings("scene: room.sdf\nmap: {z: [0, 2500]}\n" + robots),
                ElementsAre("rig.yaml:2: map.z: 0, 2500 looks like millimetres, but lengths are "
                            "metres; did you mean 0, 2.5?"));
    EXPECT_THAT(warnings("scene: room.sdf\nmap: {z: [0, 250]}\n" + robots), IsEmpty());
}

TEST_F(ConfigUnits, WhatPeopleMeanIsNotTold) {
    EXPECT_THAT(parse(with("mount: {xyz: [0.2, 0, 0.25], rpy: [3.14159, 0, -1.57]}")).warnings,
                IsEmpty());
    EXPECT_THAT(parse(with("mount: {rpy: [0, 0, 7.853982]}")).warnings, IsEmpty());
}

}  // namespace
}  // namespace scipd::daemon
