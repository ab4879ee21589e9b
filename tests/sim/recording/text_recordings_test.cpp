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
    line += " 1 2 0.5 3 4 0.6 1700000000.25 host 0.1\n";
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
    EXPECT_EQ(scan.pose, (sim::LaserPose{1, 2, 0.5}));
}

TEST(Carmen, ReadsNewLasersWithAndWithoutRemissions) {
    const ReadBack back = read_bytes(
        "ROBOTLASER1 0 -1.5 3.0 0.75 30.0 0.01 0 3 1.0 2.0 3.0 3 7 8 9 4 5 6 0 0 0 0.1 0.2 0.3 0.4 "
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
    EXPECT_EQ(scans[0].pose, (sim::LaserPose{4, 5, 6}));
    EXPECT_FALSE(scans[1].pose);
    EXPECT_EQ(scans[2].pose, (sim::LaserPose{0.5, 0.6, 0}));
}

TEST(Rows, AreScansWithoutAWord) {
    for (const char* text :
         {"1000 2000 65533\n1001 2001 7\n",
          "# of a wall\n1000,2000,65533\n"
          "1001, 2001, 7,\n",
          "1000;2000;65533\r\n1001;2001;7\r\n", "\n1000.0\t2000.0\t65533\n1.001e+03\t2001\t+7\n"}) {
        const ReadBack back = read_bytes(text);
        EXPECT_EQ(back.fault, "") << text;
        EXPECT_EQ(back.format, "rows");
        ASSERT_THAT(back.scans(), SizeIs(2)) << text;
        EXPECT_THAT(back.scans()[0].ranges, ElementsAre(1000, 2000, 65533)) << text;
        EXPECT_THAT(back.scans()[1].ranges, ElementsAre(1001, 2001, 7)) << text;
        EXPECT_EQ(back.scans()[0].unit, sim::RangeUnit::millimetres);
    }
}

TEST(Rows, OfNumpyAreMetresWithWhatIsNoNumber) {
    const ReadBack back = read_bytes("1.5e+00 nan inf\n2.5e+00 1.0e+00 -inf\n");
    EXPECT_EQ(back.fault, "");
    ASSERT_THAT(back.scans(), SizeIs(2));
    EXPECT_EQ(back.scans()[0].unit, sim::RangeUnit::metres);
    EXPECT_EQ(back.scans()[0].ranges[0], 1.5);
    EXPECT_TRUE(std::isnan(back.scans()[0].ranges[1]));
    EXPECT_TRUE(std::isinf(back.scans()[0].ranges[2]));
}

TEST(Rows, HaveWhatSpreadsheetsWrite) {
    const ReadBack back = read_bytes(
        "\xEF\xBB\xBF"
        "1000,,NaN\r\n1001,2001,Inf\r\n");
    EXPECT_EQ(back.fault, "");
    ASSERT_THAT(back.scans(), SizeIs(2));
    EXPECT_EQ(back.scans()[0].ranges[0], 1000);
    EXPECT_TRUE(std::isnan(back.scans()[0].ranges[1]));
    EXPECT_TRUE(std::isnan(back.scans()[0].ranges[2]));
    EXPECT_TRUE(std::isinf(back.scans()[1].ranges[2]));
}

TEST(Rows, AreReadAsManyProgramsWriteThem) {
    const std::string mark = "\xEF\xBB\xBF";
    for (const std::string& text :
         {mark + "range_0;range_1;range_2\r\n1001;-nan;infinity\r\n",
          mark + "# by a "
                 "spreadsheet\r\n\r\n\"range_0\"\t\"range_1\"\t\"range_2\"\r\n1001\t-NaN\tInf\r\n",
          std::string("range[0], range[1], range[2]\n+1001,\t,+Infinity\n"),
          std::string("0 range(0) range(1) range(2)\n# a comment\n   0 1001   nan(ind) inf  \n")}) {
        const ReadBack back = read_bytes(text);
        EXPECT_EQ(back.fault, "") << text;
        ASSERT_THAT(back.scans(), SizeIs(1)) << text;
        const auto ranges = back.scans()[0].ranges;
        ASSERT_THAT(ranges, SizeIs(3)) << text;
        EXPECT_EQ(ranges[0], 1001) << text;
        EXPECT_TRUE(std::isnan(ranges[1])) << text;
        EXPECT_TRUE(std::isinf(ranges[2])) << text;
        EXPECT_THAT(back.scans()[0].directions.first_step, Optional(0)) << text;
    }
}

TEST(Rows, MayBeNone) {
    for (const std::string text : {"range_0,range_1,range_2\n", "# 1\n0,1,2,3,4\n\n\n5,9,7,6,5"}) {
        const ReadBack back = read_bytes(text);
        EXPECT_EQ(back.fault, "") << text;
        EXPECT_EQ(back.format, "rows");
        EXPECT_THAT(back.streams, SizeIs(1));
        EXPECT_THAT(back.scans(), IsEmpty()) << text;
    }
}

TEST(Rows, WithoutALineEndAreLeftOut) {
    const ReadBack back = read_bytes("1000 2000 3000\n1001 2001 30");
    EXPECT_EQ(back.fault, "");
    EXPECT_THAT(back.scans(), SizeIs(1));
    EXPECT_THAT(back.warnings, ElementsAre("FILE ends within line 2, which is left out"));
}

// The same instant in s, ms, µs and ns; a time of before 1973 is since the log began.
TEST(Rows, HaveTimesInAnyUnit) {
    const ReadBack back = read_bytes(
        "time,r0,r1,r2\n1769860800.123456789,1,2,3\n1769860800123.456789,1,2,3\n"
        "1769860800123456.789,1,2,3\n1769860800123456789,1,2,3\n12.5,1,2,3\nnan,1,2,3\n");
    EXPECT_EQ(back.fault, "");
    const auto scans = back.scans();
    ASSERT_THAT(scans, SizeIs(6));
    for (std::size_t row = 0; row < 4; ++row)
        EXPECT_EQ(scans[row].host_time, sim::host_time_at(1'769'860'800, 123'456'789)) << row;
    EXPECT_FALSE(scans[4].host_time);
    EXPECT_FALSE(scans[5].host_time);
}

TEST(Rows, MayStandUnderNames) {
    const ReadBack back = read_bytes(
        "time,\"range_mm_44\",\"range_mm_45\",\"range_mm_46\",who,remission44,remission45,"
        "remission46\n1769860800.5,10.5,1001,7,me,1,2,3\n");
    EXPECT_EQ(back.fault, "");
    EXPECT_THAT(back.warnings, ElementsAre("FILE: these columns are left out: 'who'"));
    EXPECT_EQ(back.streams[0].type, "rows of numbers under numbers of steps");
    ASSERT_THAT(back.scans(), SizeIs(1));
    const auto scan = back.scans()[0];
    EXPECT_THAT(scan.ranges, ElementsAre(10.5, 1001, 7));
    EXPECT_THAT(scan.intensities, ElementsAre(1, 2, 3));
    EXPECT_EQ(scan.unit, sim::RangeUnit::millimetres);
    EXPECT_THAT(scan.directions.first_step, Optional(44));
    EXPECT_EQ(scan.host_time, sim::host_time_at(1'769'860'800, 500'000'000));
}

// As `rostopic echo -p /scan` writes them.
TEST(Rows, OfRostopicHaveTheirTimesAndAngles) {
    const ReadBack back = read_bytes(
        "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.angle_min,"
        "field.angle_max,field.angle_increment,field.time_increment,field.scan_time,"
        "field.range_min,field.range_max,field.ranges0,field.ranges1,field.ranges2,"
        "field.intensities0,field.intensities1,field.intensities2\n"
        "1769860800250000000,1,1769860800200000000,laser,-1.5,1.5,1.5,0.0,0.1,0.02,30.0,"
        "2.0,inf,3.25,100.0,0.0,200.0\n");
    EXPECT_EQ(back.fault, "");
    ASSERT_THAT(back.scans(), SizeIs(1));
    const auto scan = back.scans()[0];
    EXPECT_EQ(scan.unit, sim::RangeUnit::metres);
    EXPECT_EQ(scan.ranges[2], 3.25);
    EXPECT_THAT(scan.intensities, ElementsAre(100, 0, 200));
    EXPECT_EQ(scan.host_time, sim::host_time_at(1'769'860'800, 250'000'000));
    EXPECT_THAT(scan.directions.first_rad, Optional(-1.5));
    EXPECT_THAT(scan.directions.increment_rad, Optional(1.5));
}

TEST(Rows, MayStandUnderAnglesOrSteps) {
    const auto in_radians = [](double degrees) { return degrees * std::numbers::pi / 180; };
    const ReadBack radians = read_bytes("-1,-0.75,-0.5,-0.25\n2.5,2.5,2.5,3.5\n");
    EXPECT_EQ(radians.streams[0].type, "rows of numbers under angles in radians, taken for metres");
    const ReadBack turn = read_bytes("-135.0;-45.0;45.0;135.0\n1000;1001;1002;1009\n");
    EXPECT_EQ(turn.streams[0].type,
              "rows of numbers under angles in degrees, taken for millimetres");
    ASSERT_THAT(turn.scans(), SizeIs(1));
    EXPECT_THAT(turn.scans()[0].ranges, ElementsAre(1000, 1001, 1002, 1009));
    EXPECT_THAT(turn.scans()[0].directions.first_rad, Optional(DoubleEq(in_radians(-135))));
    EXPECT_THAT(turn.scans()[0].directions.increment_rad, Optional(DoubleEq(in_radians(90))));
    const ReadBack steps = read_bytes("0,1,2,3,4\n1000,1001,1002,1007,7\n");
    EXPECT_EQ(steps.streams[0].type,
              "rows of numbers under numbers of steps, taken for millimetres");
    EXPECT_THAT(steps.scans()[0].directions.first_step, Optional(0));
    // What goes up evenly in all rows is made up, and a row alone is a scan.
    EXPECT_THAT(read_bytes("0 1 2 3\n4 5 6 7\n").scans(), SizeIs(2));
    EXPECT_THAT(read_bytes("0 1 2 3\n").scans(), SizeIs(1));
    EXPECT_THAT(read_bytes("1000 1201 1350 1500\n1000 1201 1350 1501\n").scans(), SizeIs(2));
}

TEST(Rows, HaveTheUnitOfAllOfThem) {
    const auto unit_of = [](const char* text) { return read_bytes(text).scans().at(0).unit; };
    EXPECT_EQ(unit_of("0 0 0\n1.5 2.5 0\n"), sim::RangeUnit::metres);
    EXPECT_EQ(unit_of("310.5 420.25 0.0\n300.5 405.25 0.0\n"), sim::RangeUnit::millimetres);
    EXPECT_EQ(unit_of("80.5 20.25 0.0\n300.5 405.25 700.0\n"), sim::RangeUnit::millimetres);
    EXPECT_EQ(unit_of("7 7 7\n7 7 7\n"), sim::RangeUnit::millimetres);
    EXPECT_EQ(unit_of("1.5 2.5 9999.0\n"), sim::RangeUnit::metres);  // it stands for nothing
}

TEST(Rows, OfAsManyStepsAreNotThereforeOfCoreSlam) {
    std::string text;
    for (int step = 0; step < 707; ++step)
        text += std::to_string(1000 + step) + " ";
    const ReadBack back = read_bytes(text + "\n");
    EXPECT_EQ(back.streams[0].identity.model, "");
    ASSERT_THAT(back.scans(), SizeIs(1));
    EXPECT_THAT(back.scans()[0].ranges, SizeIs(707));
}

TEST(Rows, OfCoreSlamAreScansOfAUrg) {
    std::string text;
    for (int row = 0; row < 2; ++row) {
        text += std::to_string(212'387'282 + 102'000 * row);
        for (int i = 1; i < 24; ++i)
            text += " " + std::to_string(100 * i) + (i == 7 ? ".5" : "");
        for (int step = 44; step <= 725; ++step)
            text += " " + std::to_string(1000 + step + row);
        text += " 0 \n";
    }
    const ReadBack back = read_bytes(text);
    EXPECT_EQ(back.fault, "");
    ASSERT_THAT(back.scans(), SizeIs(2));
    EXPECT_EQ(back.streams[0].identity.model, "URG-04LX");
    const auto scan = back.scans()[1];
    EXPECT_THAT(scan.stamp_us, Optional(212'489'282U));
    ASSERT_THAT(scan.ranges, SizeIs(682));
    EXPECT_EQ(scan.ranges[0], 1045);
    EXPECT_EQ(scan.ranges[681], 1726);
    EXPECT_THAT(scan.directions.first_step, Optional(44));
    EXPECT_THAT(scan.directions.first_rad,
                Optional(DoubleNear((44 - 384) * 2 * std::numbers::pi / 1024, 1e-9)));
}

TEST(Rows, OfCoreSlamMayLackTheirTime) {
    std::string text;
    for (const char* time : {"212387282", "nan", "-5", "1e300"}) {
        text += time;
        for (int i = 1; i < 24 + 682; ++i)
            text += " 1000";
        text += "\n";
    }
    const auto scans = read_bytes(text).scans();
    ASSERT_THAT(scans, SizeIs(4));
    EXPECT_THAT(scans[0].stamp_us, Optional(212'387'282U));
    for (std::size_t row = 1; row < 4; ++row)
        EXPECT_FALSE(scans[row].stamp_us) << row;
}

TEST(Rows, HaveAnglesBelowZeroBehindDashes) {
    for (const char* names : {"range-2,range-1,range0,range1,range2", "deg-2,deg-1,deg0,deg1,deg2",
                              "r_-2,r_-1,r_-2.2e-16,r_1,r_2"}) {
        const ReadBack back = read_bytes(std::string(names) + "\n1000,1001,1002,1003,1004\n");
        EXPECT_EQ(back.fault, "") << names;
        ASSERT_THAT(back.scans(), SizeIs(1)) << names;
        EXPECT_THAT(back.scans()[0].ranges, SizeIs(5)) << names;
        EXPECT_LT(back.scans()[0].directions.first_rad, 0.0) << names;
        EXPECT_THAT(back.warnings, IsEmpty()) << names;
    }
}

TEST(Rows, MayEndInAnEmptyCell) {
    const ReadBack back = read_bytes("range_0,range_1,range_2\n1000,1001,\n1003,,1005\n");
    EXPECT_EQ(back.fault, "");
    ASSERT_THAT(back.scans(), SizeIs(2));
    EXPECT_THAT(back.scans()[0].ranges, SizeIs(3));
    EXPECT_EQ(back.scans()[0].ranges[1], 1001);
    EXPECT_EQ(back.scans()[1].ranges[2], 1005);
}

TEST(Rows, AreNotReadInCentimetres) {
    EXPECT_THAT(read_bytes("range_cm_0,range_cm_1,range_cm_2\n100,101,102\n").fault,
                HasSubstr("column 1: 'range_cm_0' is in centimetres; write millimetres"));
}

TEST(Rows, LeaveOutTheIndexOfPandas) {
    const ReadBack back = read_bytes(",0,1,2,3\n0,1000,1001,1002,1003\n1,1004,1005,1006,1007\n");
    EXPECT_EQ(back.fault, "");
    ASSERT_THAT(back.scans(), SizeIs(2));
    EXPECT_THAT(back.scans()[0].ranges, ElementsAre(1000, 1001, 1002, 1003));
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
    EXPECT_FALSE(scans[0].pose);
    EXPECT_EQ(scans[1].pose, (sim::LaserPose{1, 2, 0}));
    EXPECT_THAT(back.warnings, ElementsAre(HasSubstr("what 'position2d' says is left out")));
}

TEST(Player, ReadsScansWhosePlaceIsNoNumber) {
    const ReadBack back = read_bytes(
        "## Player version 2.0.1 \n## File version 0.3.0 \n"
        "0000001700.350 16777343 6665 laser 01 001 002 0012 nan nan nan -1.5708 "
        "+1.5708 +0.78539816 +8.0000 0001 4.000  4 \n");
    EXPECT_EQ(back.fault, "");
    ASSERT_THAT(back.scans(), SizeIs(1));
    EXPECT_THAT(back.scans()[0].ranges, ElementsAre(4));
    EXPECT_THAT(back.scans()[0].directions.first_rad, Optional(-1.5708));
    EXPECT_FALSE(back.scans()[0].pose);
}

TEST(Carmen, ReadsRangesThatAreNoNumber) {
    const ReadBack back =
        read_bytes("FLASER 3 1.5 nan inf nan 2 0.5 3 4 0.6 1700000000.25 host 0.1\r\n");
    EXPECT_EQ(back.fault, "");
    ASSERT_THAT(back.scans(), SizeIs(1));
    const auto scan = back.scans()[0];
    EXPECT_EQ(scan.ranges[0], 1.5);
    EXPECT_TRUE(std::isnan(scan.ranges[1]));
    EXPECT_TRUE(std::isinf(scan.ranges[2]));
    EXPECT_FALSE(scan.pose);
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
        Wrong{"1 2 3\n1 2\n", "FILE:2: must have 3 numbers as the first row, not 2"},
        Wrong{"1 2 3\n1 2 x\n", "FILE:2: column 3: 'x' is no number"},
        Wrong{"3,129;3,132\n", "FILE:1: column 1: '3,129' is no number; write decimal points"},
        Wrong{"3,129\t3,132\n", "FILE:1: column 2: '129?3' is no number"},
        Wrong{"1769860800.5,1.5,2.5\n", "FILE:1: column 1: '1769860800.5' is no range; leave out"},
        Wrong{"where,who,why\n1000,1001,1002\n",
              "FILE:1: column 1: 'where' and the other names here are none of ranges; name those"},
        Wrong{"1000,1204,n.a.,1050\n1000,1204,1,1050\n", "FILE:1: column 3: 'n.a.' is no number"},
        Wrong{"range_0,range_1,range_2\n1000,1001,x\n", "FILE:2: column 3: 'x' is no number"},
        Wrong{"range_0,range_1,range_2\n1000,1001\n", "FILE:2: must have 3 numbers as the first"},
        Wrong{"Dear reader\n", "FILE: begins like no recording that is read: MCAP, a bag of ROS"},
        Wrong{"\x1F\x8B..", "FILE: is packed by gzip; unpack it: gunzip FILE"},
        Wrong{"PK\x03\x04..", "FILE: is a zip"},
        Wrong{"#ROSBAG V1.2\n", "convert it to 2.0: rosbag migrate"},
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
        Wrong{"# host_time_s,stamp_ms,distance_mm_4\n1,,5\n",
              "FILE:2: stamp_ms must be a number of milliseconds, not ''"},
        Wrong{"# host_time_s,stamp_ms,distance_mm_4\nx,2,5\n",
              "FILE:2: host_time_s must be a number, not 'x'"},
        Wrong{"# host_time_s,stamp_ms,distance1_mm_4,distance1_mm_5,intensity1_4,"
              "intensity1_5\n1,2,5,6,7,\n",
              "FILE:2: there must be an intensity for each distance"},
        Wrong{"# host_time_s,stamp_ms,intensity_4,distance_mm_4\n",
              "FILE:1: the distances must come first"},
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
        Wrong{"FLASER 3 1 2 3\nFLASER 0 0 0\n",
              "FILE:1: FLASER must have as many numbers as it says, and end in a time"},
        Wrong{"RAWLASER1 0 -1.5 3.0 x 20.0 0.01 0 2 4.0 5.0 0 1700000002 host 2\n",
              "FILE:1: RAWLASER1 must have as many numbers as it says"},
        Wrong{"## Player version 2\n1 1 1 laser 00 001 001 1 0 0 0 8 1 1.0 1 7\n# \n",
              "FILE:2: must have a range and an intensity for each reading"},
        Wrong{"## Player version 1\nlaser 0 0\n0 0\n", "FILE:2: a line must begin with time, host"},
        Wrong{"## Player version 2\n1 1 1 laser 00 001 001 1 0 0 0 8 2 1.0 1\n# \n",
              "FILE:2: must have a range and an intensity for each reading"}));

TEST(Text, MayBeginWithAByteOrderMark) {
    const std::string row = "FLASER 2 1 2 1 2 0.5 3 4 0.6 1700000000.25 host 0.1\n";
    for (const auto& [format, text] : std::initializer_list<std::pair<std::string, std::string>>{
             {"jsonl", "{\"distances_mm\":[1,2]}\n"},
             {"ubh", "[model]\nUST-10LX\n[scan]\n1;2\n"},
             {"csv", "# host_time_s,stamp_ms,distance_mm_4,distance_mm_5\r\n1,2,1,2\r\n"},
             {"carmen", row},
             {"rows", "1 2\n"}}) {
        const ReadBack back = read_bytes("\xEF\xBB\xBF" + text);
        EXPECT_EQ(back.fault, "") << format;
        EXPECT_EQ(back.format, format);
        ASSERT_THAT(back.scans(), SizeIs(1)) << format;
        EXPECT_THAT(back.scans()[0].ranges, ElementsAre(1, 2)) << format;
    }
}

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

TEST(Lines, ThatAreLongerThanAnyScanAreRefused) {
    EXPECT_EQ(read_bytes("1 2 3\n" + std::string((16 << 20) + (1 << 17), '4')).fault,
              "FILE:2: the line is longer than any scan: this is no recording as text");
    EXPECT_EQ(read_bytes("1" + std::string(2 << 20, ',') + "\n").fault,
              "FILE:1: a row of 2097152 cells is no scan");
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
