// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A driver that calibrates its clock as urg_node does, by the steps that its sources describe, in
// words of our own: how old are scans when they come, and how long does it take? Three runs with
// real UST-10LX said -0.0208, -0.0212 and -0.0210 s, and took 1.0035, 1.0015 and 1.0018 s
// (ros-drivers/urg_node#36, #37). World time is stepped; the driver's host takes its time.
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/models/model_registry.h"
#include "protocol/char_code.h"
#include "tests/daemon/stepped_driver.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

/// Where its mirror is at the start, and what a command takes besides the scanner's own time.
class Latency : public testing::TestWithParam<std::tuple<sim::Time, sim::Time>> {
  protected:
    static constexpr int rounds = 10;
    static constexpr double turn_ms = 25.05;

    static SensorConfig sensor() {
        SensorConfig config = ideal_sensor("UST-10LX");
        config.timing = Timing::real;
        config.clock.phase = std::get<0>(GetParam());
        return config;
    }

    static double in_ms(sim::Time time) {
        return std::chrono::duration<double, std::milli>(time).count();
    }

    /// In a reply to TM1 and in a scan, it is the line behind the status.
    static double stamp_ms(const std::string& message) {
        const std::size_t status = message.find('\n') + 1;
        const std::size_t stamp = message.find('\n', status) + 1;
        const auto shown = protocol::decode(std::string_view(message).substr(stamp, 4));
        return static_cast<double>(shown.value_or(0));
    }

    std::string ask(const std::string& line) {
        driver_.wait(std::get<1>(GetParam()) / 2);
        driver_.send(line);
        const SteppedDriver::Received reply = driver_.await();
        driver_.wait_until(std::max(driver_.now(), reply.at + std::get<1>(GetParam()) / 2));
        return reply.bytes;
    }

    /// By how much the scanner's clock is ahead of the host's.
    double clock_offset_ms() {
        EXPECT_EQ(ask("TM0"), "TM0\n00P\n\n");
        const double asked_ms = in_ms(driver_.now());
        const double shown_ms = stamp_ms(ask("TM1"));
        const double answered_ms = in_ms(driver_.now());
        EXPECT_EQ(ask("TM2"), "TM2\n00P\n\n");
        return shown_ms - (asked_ms + answered_ms) / 2;
    }

    /// By how much the stamp of a stream's first scan is ahead of the scan's arrival.
    double scan_offset_ms() {
        EXPECT_EQ(ask("MD0000108000000"), "MD0000108000000\n00P\n\n");
        const SteppedDriver::Received scan = driver_.await();
        arrived_ms_.push_back(in_ms(scan.at));
        driver_.wait_until(std::max(driver_.now(), scan.at));
        EXPECT_EQ(ask("QT"), "QT\n00P\n\n");
        return stamp_ms(scan.bytes) - in_ms(scan.at);
    }

    double latency_ms() {
        const double first = clock_offset_ms();
        double before = 0.0;
        std::vector<double> offsets;
        for (int i = 0; i < rounds; ++i) {
            const double scan = scan_offset_ms() - first;
            const double after = clock_offset_ms() - first;
            offsets.push_back(scan - (before + after) / 2);
            before = after;
        }
        std::ranges::sort(offsets);
        // The driver counts from the rear: an eighth of a turn before a UST's first step.
        constexpr double from_rear_ms = 25.0 / 8;
        return offsets[rounds / 2] + from_rear_ms;
    }

    SteppedDriver driver_{sensor()};
    std::vector<double> arrived_ms_;  ///< the first scan of each round
};

TEST_P(Latency, IsWhatDriversPrintOfRealOnes) {
    driver_.wait_until(1s);
    const double begin_ms = in_ms(driver_.now());
    EXPECT_NEAR(latency_ms(), -21.0, 1.0);
    EXPECT_NEAR(in_ms(driver_.now()) - begin_ms, rounds * 4 * turn_ms, turn_ms);
    // Each round takes four turns, but for the frame of 1 ms that scans wait for.
    for (int i = 1; i < rounds; ++i)
        EXPECT_NEAR(arrived_ms_[i] - arrived_ms_[i - 1], 4 * turn_ms, 1.0) << "round " << i;
}

// A host near by, one behind a slow switch, and one that is busy.
INSTANTIATE_TEST_SUITE_P(WhereverTheMirrorIs, Latency,
                         testing::Combine(testing::Values(0ms, 3ms, 9ms, 14ms, 20ms, 24ms),
                                          testing::Values(100us, 1ms, 3ms)));

}  // namespace
}  // namespace scipd::daemon
