// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A robot whose poses come late and five at a time, as from a simulator that is a step behind. With
// wait_ms its scans are late but right. Without it they are on time but wrong, unless the robot
// goes on as it moved, which is the default.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/udp_sender.h"

namespace scipd::tests {
namespace {

using namespace std::chrono_literals;
using Steady = std::chrono::steady_clock;

// The robot drives from x = -2 m, 5 m before the wall, at 1 m/s, so that it moves a millimetre in
// each millisecond of the scanner.
constexpr int drive_ms = 2300;
constexpr unsigned begins_mm = 5000;
constexpr unsigned ends_mm = begins_mm - drive_ms;
constexpr int pose_ms = 20;
constexpr int burst_ms = 100;
constexpr int wait_ms = 500;

struct Seen {
    std::uint32_t stamp_ms;
    unsigned distance_mm;
};

class LatePoses : public testing::Test {
  protected:
    [[nodiscard]] Arguments waiting_for(int ms) const {
        return with("after: hold, stale_s: 60, wait_ms: " + std::to_string(ms));
    }

    [[nodiscard]] Arguments with(const std::string& keys) const {
        return {"--config",
                directory_.write("late.yaml",
                                 "scene: " + scene("square_room.sdf").string() +
                                     "\nrobots:\n  robot:\n    pose: {xyz: [-2, 0, 0]}\n"
                                     "    poses: {from: 'udp:127.0.0.1:" +
                                     std::to_string(sender_.port()) + "', " + keys +
                                     "}\n    sensors:\n      scanner:\n        model: UST-10LX\n"
                                     "        mount: {xyz: [0, 0, 0.3]}\n"
                                     "        tcp: '127.0.0.1:0'\n        accuracy: ideal\n")};
    }

    /// Records all scans from the start until a while after the robot has stopped.
    static std::vector<Seen> watch(ScannerWire& wire) {
        std::vector<Seen> seen;
        for (int standing = 0; standing < 10;) {
            const auto scan = wire.next_scan();
            seen.push_back({scan.stamp_ms, scan.distances_mm.front()});
            if (seen.back().distance_mm == ends_mm) ++standing;
        }
        return seen;
    }

    /// Each burst is sent when the last of its poses is due. Returns how late the worst burst was.
    std::chrono::milliseconds drive() const {
        Steady::duration worst{};
        const Steady::time_point begin = Steady::now();
        sender_.send(line(0));
        for (int burst = burst_ms; burst <= drive_ms; burst += burst_ms) {
            const Steady::time_point due = begin + std::chrono::milliseconds(burst);
            std::this_thread::sleep_until(due);
            std::string lines;
            for (int ms = burst - burst_ms + pose_ms; ms <= burst; ms += pose_ms)
                lines += line(ms);
            sender_.send(lines);
            worst = std::max(worst, Steady::now() - due);
        }
        return std::chrono::ceil<std::chrono::milliseconds>(worst);
    }

    /// Odometry of the same drive, as often as it is usual; the robot stands at the end.
    void drive_with_odometry(int period_ms) const {
        const Steady::time_point begin = Steady::now();
        for (int ms = 0; ms <= drive_ms + 10 * period_ms; ms += period_ms) {
            std::this_thread::sleep_until(begin + std::chrono::milliseconds(ms));
            sender_.send(line(ms));
        }
    }

    static std::string line(int ms) {
        return R"({"t":)" + std::to_string(1e-3 * ms) + R"(,"xyz":[)" +
               std::to_string(-2 + 1e-3 * std::min(ms, drive_ms)) + ",0,0]}\n";
    }

    TempDir directory_;
    UdpSender sender_;
};

/// The largest difference between the way driven between two scans and the time between them.
long worst_mm(const std::vector<Seen>& seen, unsigned margin_mm = 50) {
    long worst = 0;
    int pairs = 0;
    for (std::size_t i = 1; i < seen.size(); ++i) {
        if (seen[i - 1].distance_mm > begins_mm - margin_mm ||
            seen[i].distance_mm < ends_mm + margin_mm)
            continue;
        const long passed_ms = static_cast<long>(seen[i].stamp_ms) - seen[i - 1].stamp_ms;
        const long driven_mm = static_cast<long>(seen[i - 1].distance_mm) - seen[i].distance_mm;
        worst = std::max(worst, std::abs(driven_mm - passed_ms));
        ++pairs;
    }
    EXPECT_GT(pairs, 10);
    return worst;
}

/// Repeats the drive if this machine could not send the poses in time.
TEST_F(LatePoses, AreWaitedForUpToTheBound) {
    bool in_time = false;
    for (int attempt = 0; attempt < 5 && !in_time; ++attempt) {
        const DaemonProcess daemon(directory_, waiting_for(wait_ms));
        ScannerWire wire = ScannerWire::tcp(daemon.port());
        ASSERT_EQ(wire.ask(stream_of_one_beam), "00");
        std::atomic<std::chrono::milliseconds> late{};
        std::jthread simulator([&] { late = drive(); });
        const std::vector<Seen> seen = watch(wire);
        simulator.join();
        in_time = late.load() < std::chrono::milliseconds(wait_ms - burst_ms - 100);
        if (!in_time) continue;
        EXPECT_LE(worst_mm(seen), 2);
        for (std::size_t i = 1; i < seen.size(); ++i)
            EXPECT_EQ(turns_between(seen[i - 1].stamp_ms, seen[i].stamp_ms), 1);
        // The scans after the last pose waited for another pose up to the bound, and then left.
        const auto status = daemon.sensor_status();
        EXPECT_EQ(status.at("lost"), 0);
        EXPECT_GE(status.at("lateness_ms").at("max").get<double>(), wait_ms - 1);
    }
    EXPECT_TRUE(in_time) << "this machine is too busy to be in time";
}

// At 10 Hz each pose is four scans old when the next one comes.
TEST_F(LatePoses, OfOdometryAreNotNeededWhileTheRobotGoesOnAsItMoved) {
    const DaemonProcess daemon(directory_, with("stale_s: 2"));
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    ASSERT_EQ(wire.ask(stream_of_one_beam), "00");
    std::jthread odometry([&] { drive_with_odometry(100); });
    EXPECT_LE(worst_mm(watch(wire), 250), 2);
    odometry.join();
    EXPECT_THAT(daemon.standard_error(), testing::HasSubstr("poses of robot come "));
    EXPECT_THAT(daemon.standard_error(), testing::Not(testing::HasSubstr("poses up to")));
}

TEST_F(LatePoses, OfOdometryAreToldToBeTooSeldomWhereTheRobotHolds) {
    const DaemonProcess daemon(directory_, with("after: hold"));
    drive_with_odometry(100);
    EXPECT_TRUE(eventually([&] {
        return daemon.standard_error().find("ms old; set wait_ms: 1") != std::string::npos;
    }));
}

TEST_F(LatePoses, AreMissedWithoutWaiting) {
    const DaemonProcess daemon(directory_, waiting_for(0));
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    ASSERT_EQ(wire.ask(stream_of_one_beam), "00");
    std::jthread simulator([&] { (void)drive(); });
    // The robot stands still for 100 ms and then jumps.
    EXPECT_GE(worst_mm(watch(wire)), burst_ms - 50);
}

}  // namespace
}  // namespace scipd::tests
