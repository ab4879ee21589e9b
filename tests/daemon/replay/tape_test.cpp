// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/replay/tape.h"

#include <chrono>

#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

TapedScan scan_of(std::uint32_t first, bool with_echoes) {
    TapedScan scan{{first, first + 1, 65533}, {7, 8, first}, {}};
    for (int i = 0; with_echoes && i < 3; ++i) {
        protocol::StepEchoes step{.count = 2};
        step.echo[0] = {first, 1};
        step.echo[1] = {first + 100, 2};
        scan.echoes.push_back(step);
    }
    return scan;
}

TEST(Tape, GivesBackWhatWasRecorded) {
    Tape tape(3, true);
    tape.add(scan_of(1000, true), 0xFFFFF0, 0ms);
    tape.add(scan_of(2000, true), 9, 25ms);
    tape.end(30ms);
    ASSERT_EQ(tape.size(), 2U);
    const TapedScan second = tape.scan(1);
    EXPECT_EQ(second.distance, scan_of(2000, true).distance);
    EXPECT_EQ(second.intensity, scan_of(2000, true).intensity);
    ASSERT_EQ(second.echoes.size(), 3U);
    EXPECT_EQ(second.echoes[2].count, 2);
    EXPECT_EQ(second.echoes[2].echo[1].distance, 2100U);
    EXPECT_EQ(tape.scan(0).distance.front(), 1000U);
    EXPECT_EQ(tape.stamp_ms(0), 0xFFFFF0U);
    EXPECT_EQ(tape.lasts(0), 25ms);
    EXPECT_EQ(tape.lasts(1), 30ms);
}

TEST(Tape, FindsTheScanThatIsUnderWay) {
    Tape tape(3, false);
    for (int i = 0; i < 10; ++i)
        tape.add(scan_of(1000, false), static_cast<std::uint32_t>(25 * i), i * 25ms);
    tape.end(25ms);
    EXPECT_TRUE(tape.scan(4).echoes.empty());
    EXPECT_EQ(tape.at(0ms), 0U);
    EXPECT_EQ(tape.at(74ms), 2U);
    EXPECT_EQ(tape.at(75ms), 3U);
    EXPECT_EQ(tape.at(1h), 9U);
}

}  // namespace
}  // namespace scipd::daemon
