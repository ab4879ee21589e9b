// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A driver that others wrote, MRPT's CHokuyoURG as Debian ships it, gets right scans of a known
// room from a running scipd, over TCP and over the tty.
#include "tests/end_to_end/mrpt_driver.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/square_room.h"
#include "tests/support/daemon_process.h"
#include "tests/support/udp_sender.h"

namespace scipd::tests {
namespace {

using Scan = MrptDriver::Scan;

std::vector<std::string> arguments(const Product& product, Link link,
                                   const std::filesystem::path& world) {
    return {"--scene",    world,
            "--model",    product.name,
            "--mount",    "0,0,0.3,0,0,0",
            "--accuracy", "ideal",
            "--tcp",      link == Link::tcp ? "127.0.0.1:0" : "none",
            "--pty",      link == Link::tty ? "auto" : "none"};
}

struct Setup {
    Product product;
    Link link;

    friend std::ostream& operator<<(std::ostream& out, const Setup& setup) {
        return out << setup.product.name << (setup.link == Link::tcp ? " tcp" : " tty");
    }
};

class MrptDriverTest : public testing::TestWithParam<Setup> {
  protected:
    [[nodiscard]] const Product& product() const { return GetParam().product; }
    [[nodiscard]] Link link() const { return GetParam().link; }

    TempDir directory_;
};

TEST_P(MrptDriverTest, SeesTheRoomAndFollowsTheRobot) {
    const UdpSender poses;
    auto options = arguments(product(), link(), scene("square_room.sdf"));
    options.insert(options.end(), {"--pose", "-1.2,0.7,2.2", "--poses",
                                   "udp:127.0.0.1:" + std::to_string(poses.port())});
    DaemonProcess daemon(directory_, options);
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    MrptDriver driver(daemon, link());

    const Scan at_start = driver.next_scan();
    expect_shape(at_start, product());
    EXPECT_GT(expect_room(at_start, product(), {-1.2, 0.7, 2.2}), product().beams() * 95 / 100);

    poses.send(R"({"xyz":[0.4,-0.3,0],"rpy":[0,0,-0.5]})");
    const Planar there{0.4, -0.3, -0.5};
    const int front = product().front_step - product().first_step;
    const double ahead_m = range_in_square_room(there, 0.0);
    Scan moved = driver.next_scan();
    for (int i = 0; i < 200 && std::abs(moved.getScanRange(front) - ahead_m) > tolerance_m; ++i)
        moved = driver.next_scan();
    // The scan before may have begun before the robot was moved.
    moved = driver.next_scan();
    EXPECT_GT(expect_room(moved, product(), there), product().beams() * 95 / 100);
}

TEST_P(MrptDriverTest, TellsWhatReturnsNothing) {
    // A wall of 2 m by 2 m, 2 m ahead, and nothing else.
    const auto world = directory_.write("wall.sdf", R"(<sdf version="1.9"><world name="wall">
        <model name="wall"><static>true</static><link name="link"><visual name="wall">
        <pose>2.05 0 0.5 0 0 0</pose><geometry><box><size>0.1 2 2</size></box></geometry>
        </visual></link></model></world></sdf>)");
    DaemonProcess daemon(directory_, arguments(product(), link(), world));
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    const Scan scan = MrptDriver(daemon, link()).next_scan();

    expect_shape(scan, product());
    const double half_wall_rad = std::atan2(1.0, 2.0);
    for (int beam = 0; beam < product().beams(); ++beam) {
        const double bearing_rad = product().bearing_rad(beam);
        if (std::abs(std::abs(bearing_rad) - half_wall_rad) < 1e-4) continue;
        const bool meets_wall = std::abs(bearing_rad) < half_wall_rad;
        ASSERT_EQ(scan.getScanRangeValidity(beam), meets_wall) << "beam " << beam;
        if (!meets_wall) continue;
        EXPECT_NEAR(scan.getScanRange(beam), 2.0 / std::cos(bearing_rad), tolerance_m);
    }
}

/// What the recorded scan of this number has at this beam, in mm.
int recorded_mm(int scan, int beam) {
    return 300 + (17 * beam + 401 * scan) % 3000;
}

std::string recording_of(const Product& product, int scans) {
    std::string lines;
    for (int scan = 0; scan < scans; ++scan) {
        nlohmann::json line{{"model", product.name},
                            {"stamp_ms", 16'777'000 + 100 * scan},
                            {"first_step", product.first_step},
                            {"cluster", 1}};
        for (int beam = 0; beam < product.beams(); ++beam)
            line["distances_mm"].push_back(recorded_mm(scan, beam));
        lines += line.dump() + "\n";
    }
    return lines;
}

TEST_P(MrptDriverTest, ReadsARecordingAsItWas) {
    constexpr int scans = 7;
    const auto file = directory_.write("recorded.jsonl", recording_of(product(), scans));
    DaemonProcess daemon(directory_, {"--replay", file, "--loop", "on", "--tcp",
                                      link() == Link::tcp ? "127.0.0.1:0" : "none", "--pty",
                                      link() == Link::tty ? "auto" : "none"});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    MrptDriver driver(daemon, link());
    std::set<int> seen;
    for (int i = 0; i < 2 * scans; ++i) {
        const Scan scan = driver.next_scan();
        expect_shape(scan, product());
        const auto is_scan = [&](int number) {
            return std::lround(1000.0 * scan.getScanRange(0)) == recorded_mm(number, 0);
        };
        int number = 0;
        while (number < scans && !is_scan(number))
            ++number;
        ASSERT_LT(number, scans) << scan.getScanRange(0);
        seen.insert(number);
        for (int beam = 0; beam < product().beams(); ++beam) {
            ASSERT_EQ(std::lround(1000.0 * scan.getScanRange(beam)), recorded_mm(number, beam))
                << "beam " << beam;
        }
    }
    EXPECT_GT(seen.size(), 3U);
}

std::string name_of(const testing::TestParamInfo<Setup>& test) {
    std::string name = test.param.product.name;
    std::ranges::replace(name, '-', '_');
    return name + (test.param.link == Link::tcp ? "_tcp" : "_tty");
}

INSTANTIATE_TEST_SUITE_P(Models, MrptDriverTest,
                         testing::Values(Setup{urg_04lx, Link::tcp}, Setup{urg_04lx, Link::tty},
                                         Setup{utm_30lx, Link::tcp}, Setup{utm_30lx, Link::tty},
                                         Setup{ust_10lx, Link::tcp}, Setup{ust_10lx, Link::tty},
                                         Setup{ust_20lx, Link::tcp}, Setup{ust_20lx, Link::tty}),
                         name_of);

/// A scanner that turns on the spot while it sweeps: each beam is fired a little later than the one
/// to its right, and so points a little farther to the left.
class Turning {
  public:
    Turning(const Product& product, double rad_per_s)
        : product_(product),
          swept_per_beam_rad_(rad_per_s * product.period_s / product.steps_per_turn) {}

    [[nodiscard]] double truth_m(double yaw_of_first_beam_rad, int beam) const {
        return range_in_square_room({}, bearing_rad(yaw_of_first_beam_rad, beam));
    }
    [[nodiscard]] std::optional<double> certain_truth_m(double yaw_of_first_beam_rad,
                                                        int beam) const {
        return certain_range_in_square_room({}, bearing_rad(yaw_of_first_beam_rad, beam));
    }

    /// The yaw that fits a scan best. It searches a grid of half a step of the scanner by some of
    /// the beams, and then finer and finer ones by all: at the edge of the pillar 0.1 mrad is 2 mm.
    [[nodiscard]] double yaw_of_first_beam_rad(const Scan& scan) const {
        double best_rad = 0.0;
        double spacing_rad = 2.0 * std::numbers::pi / 2880;
        best_rad = best_near(scan, std::numbers::pi, spacing_rad, 1440, 7);
        for (; spacing_rad > 1e-6; spacing_rad /= 5.0)
            best_rad = best_near(scan, best_rad, spacing_rad / 5.0, 10, 1);
        return best_rad;
    }

  private:
    [[nodiscard]] double bearing_rad(double yaw_rad, int beam) const {
        return yaw_rad + product_.bearing_rad(beam) + beam * swept_per_beam_rad_;
    }

    [[nodiscard]] double best_near(const Scan& scan, double middle_rad, double spacing_rad,
                                   int reach, int every) const {
        double best_rad = middle_rad;
        double least = std::numeric_limits<double>::infinity();
        for (int i = -reach; i <= reach; ++i) {
            const double yaw_rad = middle_rad + i * spacing_rad;
            double misfit = 0.0;
            for (int beam = 0; beam < product_.beams(); beam += every) {
                misfit += std::min(
                    std::abs(truth_m(yaw_rad, beam) - static_cast<double>(scan.getScanRange(beam))),
                    0.1);
            }
            if (misfit < least) {
                least = misfit;
                best_rad = yaw_rad;
            }
        }
        return best_rad;
    }

    Product product_;
    double swept_per_beam_rad_;
};

TEST(MrptDriverOnAMovingRobot, SeesTheRoomAsItTurnsDuringEachSweep) {
    const Product& product = ust_10lx;
    const double rad_per_s = std::numbers::pi / 2.0;  // as square_room.tum says, for 8 s
    const TempDir directory;
    auto options = arguments(product, Link::tcp, scene("square_room.sdf"));
    options.insert(options.end(), {"--poses", scene("square_room.tum")});
    DaemonProcess daemon(directory, options);
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    MrptDriver driver(daemon, Link::tcp);

    // The drive begins when the daemon is ready, so the robot stands still in a part of the first
    // sweep.
    for (int i = 0; i < 4; ++i)
        (void)driver.next_scan();

    const Turning turning(product, rad_per_s);
    double yaw_before_rad = 0.0;
    for (int i = 0; i < 5; ++i) {
        const Scan scan = driver.next_scan();
        const double yaw_rad = turning.yaw_of_first_beam_rad(scan);
        int compared = 0;
        for (int beam = 0; beam < product.beams(); ++beam) {
            const auto truth_m = turning.certain_truth_m(yaw_rad, beam);
            if (!truth_m) continue;
            ++compared;
            ASSERT_NEAR(scan.getScanRange(beam), *truth_m, tolerance_m) << "beam " << beam;
        }
        EXPECT_GT(compared, product.beams() * 95 / 100);
        if (i > 0) {
            // Sweeps follow each other without a gap.
            EXPECT_NEAR(std::remainder(yaw_rad - yaw_before_rad, 2.0 * std::numbers::pi),
                        rad_per_s * product.period_s, 1e-3);
        }
        yaw_before_rad = yaw_rad;
    }
}

}  // namespace
}  // namespace scipd::tests
