// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Text of others, and text that is wrong.
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>

#include "tests/sim/recording/recordings.h"

namespace scipd::tests {
namespace {

using testing::DoubleEq;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Optional;
using testing::SizeIs;

TEST(Carmen, ReadsOldLasers) {
    std::string line = "FLASER 181";
    for (int i = 0; i < 181; ++i)
        line += " 2.50";
    line += " 0 0 0 0 0 0 1700000000.25 host 0.1\n";
    const ReadBack back = read_bytes("# CARMEN Logfile\nPARAM robot_x 1\n" + line + line);
    EXPECT_EQ(back.fault, "");
    EXPECT_EQ(back.format, "carmen");
    ASSERT_THAT(back.scans(), SizeIs(2));
    const auto scan = back.scans()[0];
    EXPECT_THAT(scan.ranges, SizeIs(181));
    EXPECT_THAT(scan.directions.first_rad, Optional(DoubleEq(-std::numbers::pi / 2)));
    EXPECT_THAT(scan.directions.increment_rad, Optional(DoubleEq(std::numbers::pi / 180)));
    EXPECT_EQ(scan.host_time, sim::HostTime(std::chrono::milliseconds(1'700'000'000'250)));
    EXPECT_EQ(scan.unit, sim::RangeUnit::metres);
}

TEST(Carmen, ReadsNewLasersWithAndWithoutRemissions) {
    const ReadBack back = read_bytes(
        "ROBOTLASER1 0 -1.5 3.0 0.75 30.0 0.01 0 3 1.0 2.0 3.0 3 7 8 9 0 0 0 0 0 0 0.1 0.2 0.3 0.4 "
        "1700000001 host 1\n"
        "RAWLASER2 0 -1.5 3.0 0.75 20.0 0.01 0 2 4.0 5.0 0 1700000002 host 2\n"
        "ROBOTLASER1 0 -1.5 3.0 0.75 30.0 0.01 0 3 1.0 2.0 3.0 0.5 0.6 0 0 0 0 0.1 0.2 0.3 0.4 "
        "1700000003 host 3\n");
    EXPECT_EQ(back.fault, "");
    ASSERT_THAT(back.streams, SizeIs(2));
    EXPECT_EQ(back.streams[0].name, "ROBOTLASER1");
    EXPECT_EQ(back.streams[1].name, "RAWLASER2");
    EXPECT_THAT(back.streams[1].identity.max_range_m, Optional(20.0));
    const auto scans = back.scans();
    ASSERT_THAT(scans, SizeIs(3));
    EXPECT_THAT(scans[0].intensities, ElementsAre(7, 8, 9));
    EXPECT_THAT(scans[0].directions.increment_rad, Optional(0.75));
    EXPECT_THAT(scans[1].ranges, ElementsAre(4.0, 5.0));
    EXPECT_THAT(scans[2].intensities, IsEmpty());
}

TEST(Player, ReadsLasersOfSeveralDevices) {
    const ReadBack back = read_bytes(
        "## Player version 2.0.1 \n## File version 0.3.0 \n"
        "0000001700.250 16777343 6665 laser 00 001 001 0012 -1.5708 +1.5708 +0.78539816 +8.0000 "
        "0003 1.000  1 2.000  2 3.000  3 \n"
        "0000001700.300 16777343 6665 position2d 00 001 001 +01.000 +00.000 +0.000 0 0 0 0\n"
        "0000001700.350 16777343 6665 laser 01 001 002 0012 +01.000 +02.000 +00.000 -1.5708 "
        "+1.5708 +0.78539816 +8.0000 0001 4.000  4 \n"
        "0000001700.350 16777343 6665 laser 01 004 001 0 0 0 0 0\n");
    EXPECT_EQ(back.fault, "");
    EXPECT_EQ(back.format, "player");
    ASSERT_THAT(back.streams, SizeIs(2));
    EXPECT_EQ(back.streams[1].name, "laser:01");
    const auto scans = back.scans();
    ASSERT_THAT(scans, SizeIs(2));
    EXPECT_THAT(scans[0].ranges, ElementsAre(1, 2, 3));
    EXPECT_THAT(scans[0].intensities, ElementsAre(1, 2, 3));
    EXPECT_THAT(scans[0].directions.first_rad, Optional(-1.5708));
    EXPECT_THAT(scans[1].ranges, ElementsAre(4));
    EXPECT_THAT(back.warnings, ElementsAre(HasSubstr("what 'position2d' says is left out")));
}

TEST(Ubh, ReadsOlderVersionsOfItsMaker) {
    const ReadBack back = read_bytes(
        "[model]\r\nURG-04LX(Hokuyo Automatic Co.,Ltd.)\r\n[frontStep]\r\n384\r\n[totalSteps]\r\n"
        "1024\r\n[captureMode]\r\nGD_Capture_mode\r\n[startStep]\r\n44\r\n[endStep]\r\n46\r\n"
        "[timestamp]\r\n1000\r\n[logtime]\r\n2011:05:06:07:08:09:120\r\n[scan]\r\n900;0;902\r\n");
    EXPECT_EQ(back.fault, "");
    EXPECT_EQ(back.format, "ubh");
    ASSERT_THAT(back.scans(), SizeIs(1));
    const auto scan = back.scans()[0];
    EXPECT_THAT(scan.ranges, ElementsAre(900, 0, 902));
    EXPECT_EQ(scan.stamp_ms, 1000U);
    EXPECT_TRUE(scan.host_time);
    EXPECT_THAT(scan.directions.first_step, Optional(44));
    EXPECT_THAT(scan.directions.first_rad,
                Optional(DoubleNear(-340 * 2 * std::numbers::pi / 1024, 1e-12)));
}

/// What stands in a file, and the fault.
using Wrong = std::tuple<std::string, std::string>;

class WrongText : public testing::TestWithParam<Wrong> {};

TEST_P(WrongText, IsRefusedWithItsLine) {
    const auto& [text, fault] = GetParam();
    EXPECT_THAT(read_bytes(text).fault, HasSubstr(fault));
}

INSTANTIATE_TEST_SUITE_P(
    Files, WrongText,
    testing::Values(
        Wrong{"", "FILE: is empty"},
        Wrong{"Dear reader\n", "FILE: begins like no recording that is read: MCAP, a bag of ROS"},
        Wrong{"\x1F\x8B..", "FILE: is packed by gzip; unpack it: gunzip FILE"},
        Wrong{"PK\x03\x04..", "FILE: is a zip"},
        Wrong{"#ROSBAG V1.2\n", "rosbag migrate makes one of it"},
        Wrong{"{\"distances_mm\":[1]}\nno\n{}\n", "FILE:2: must be a JSON object, one a line"},
        Wrong{"{\"distances_mm\":[1,\"x\"]}\n", "FILE:1: distances_mm must be a list of numbers"},
        Wrong{"{\"distances_mm\":[1],\"intensities\":[1,2]}\n",
              "FILE:1: intensities must be as many as there are ranges"},
        Wrong{"{\"distances_mm\":[1],\"echoes\":[[1],2]}\n", "FILE:1: echoes must have a list"},
        Wrong{"{\"distances_mm\":[1],\"stamp_ms\":-1}\n", "FILE:1: stamp_ms must be a number from"},
        Wrong{"# host_time_s,stamp_ms,distance_mm_4,distance_mm_5\n1,2,3,4\n1,2,3\n",
              "FILE:3: there are 3 cells in place of 4"},
        Wrong{"# host_time_s,stamp_ms,distance_mm_4\n1,2,x\n",
              "FILE:2: column 3 must be a number, not 'x'"},
        Wrong{"# host_time_s,stamp_ms,range_4\n", "FILE:1: 'range_4' is neither distance_mm_S nor"},
        Wrong{"# host_time_s,stamp_ms,distance_mm_4,intensity_4,intensity_5\n",
              "FILE:1: each range and intensity must have a column for each step"},
        Wrong{"[scan]\n1;x;3\n", "FILE:2: 'x' is no mm, mm|intensity or mm&mm"},
        Wrong{"[scan]\n1|2;3\n[scan]\n",
              "FILE:2: some values have an intensity and some have none"},
        Wrong{"[timestamp]\nnow\n[scan]\n", "FILE:2: a timestamp must be a number"},
        Wrong{"[model]\nUST\nstray\n[scan]\n", "FILE:3: must be a key in brackets"},
        Wrong{"FLASER 3 1 2\nFLASER 0 0 0\n",
              "FILE:1: FLASER must have as many numbers as it says"},
        Wrong{"## Player version 1\nlaser 0 0\n0 0\n", "FILE:2: a line must begin with time, host"},
        Wrong{"## Player version 2\n1 1 1 laser 00 001 001 1 0 0 0 8 2 1.0 1\n# \n",
              "FILE:2: must have a range and an intensity for each reading"}));

TEST(JsonLines, TellsScannersApart) {
    const ReadBack back = read_bytes(
        "{\"model\":\"UST-10LX\",\"serial\":\"A\",\"distances_mm\":[1]}\n"
        "{\"model\":\"UST-10LX\",\"serial\":\"B\",\"distances_mm\":[2]}\n\n"
        "{\"model\":\"UST-10LX\",\"serial\":\"A\",\"distances_mm\":[3]}\n");
    EXPECT_EQ(back.fault, "");
    ASSERT_THAT(back.streams, SizeIs(2));
    EXPECT_EQ(back.streams[1].name, "UST-10LX B");
    ASSERT_THAT(back.items, SizeIs(3));
    EXPECT_EQ(back.items[1].stream, 1U);
    EXPECT_EQ(back.items[2].stream, 0U);
}

TEST(Lines, OfAFileThatEndsWithinOneAreReadToThat) {
    const ReadBack back = read_bytes("{\"distances_mm\":[1]}\n{\"distances_mm\":[1,2");
    EXPECT_EQ(back.fault, "");
    EXPECT_THAT(back.scans(), SizeIs(1));
    EXPECT_THAT(back.warnings, ElementsAre("FILE ends within line 2, which is left out"));
}

TEST(Lines, MayBeLongerThanAPieceOfTheFile) {
    std::string text = "{\"distances_mm\":[1";
    for (int i = 0; i < 50'000; ++i)
        text += ",12345";
    text += "]}\n";
    const ReadBack back = read_bytes(text + text);
    EXPECT_EQ(back.fault, "");
    ASSERT_THAT(back.scans(), SizeIs(2));
    EXPECT_THAT(back.scans()[1].ranges, SizeIs(50'001));
}

}  // namespace
}  // namespace scipd::tests
