// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// MRPT's driver gets the same scans from every backend: two scanners at one place of the maze, one
// by rays and one by depth buffer.
#include <cmath>
#include <cstddef>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/mrpt_driver.h"

namespace scipd::tests {
namespace {

std::string configuration() {
    return "scene: " + scene("rescue_maze.sdf").string() + R"(
robots:
  rescue:
    pose: {xyz: [1, 1, 0]}
    sensors:
      rays: {model: UST-10LX, mount: {xyz: [0, 0, 0.25]}, accuracy: ideal,
             tcp: "127.0.0.1:0", backend: embree}
      drawn: {model: UST-10LX, mount: {xyz: [0, 0, 0.25]}, accuracy: ideal,
              tcp: "127.0.0.1:0", backend: depth}
)";
}

// The share of beams at edges, where one backend may see the front and the other what is behind.
constexpr double edges = 0.01;
// The two may round differently to the scanner's unit. At 30 m, 5 mm are allowed.
double bound_m(double range_m) {
    return 0.0015 + 0.005 * range_m / 30.0;
}

TEST(MrptDriverOnBothBackends, GetsTheSameScans) {
    if (!can_draw()) GTEST_SKIP() << "nothing can be drawn here; see scipd --probe";
    const TempDir directory;
    const DaemonProcess daemon(directory,
                               {"--config", directory.write("both.yaml", configuration())});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    ASSERT_EQ(daemon.sensor_status(0).at("backend"), "embree");
    ASSERT_EQ(daemon.sensor_status(1).at("backend"), "depth");

    const MrptDriver::Scan rays = MrptDriver(daemon, Link::tcp, 0).next_scan();
    const MrptDriver::Scan drawn = MrptDriver(daemon, Link::tcp, 1).next_scan();
    expect_shape(rays, ust_10lx);
    expect_shape(drawn, ust_10lx);
    int met = 0;
    int beyond = 0;
    for (std::size_t i = 0; i < rays.getScanSize(); ++i) {
        if (rays.getScanRangeValidity(i) != drawn.getScanRangeValidity(i)) {
            ++beyond;
        } else if (rays.getScanRangeValidity(i)) {
            ++met;
            const double range_m = rays.getScanRange(i);
            if (std::abs(drawn.getScanRange(i) - range_m) > bound_m(range_m)) ++beyond;
        }
    }
    EXPECT_GT(met, ust_10lx.beams() / 2) << "the scanner stands in the maze";
    EXPECT_LE(beyond, edges * ust_10lx.beams());
}

}  // namespace
}  // namespace scipd::tests
