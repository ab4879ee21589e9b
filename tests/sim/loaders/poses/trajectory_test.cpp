// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/poses/trajectory.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/loaders/faults_of.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;
using namespace std::chrono_literals;

class Tum : public ::testing::Test {
  protected:
    std::vector<TimedPose> load(std::string_view text) {
        return load_trajectory(folder_.write("a.tum", text)).poses;
    }
    std::vector<std::string> faults(std::string_view text) {
        return faults_of([&] { load(text); }, folder_);
    }
    TempDir folder_;
};

TEST_F(Tum, stampsAreExactToTheNanosecond) {
    const auto poses = load(
        "1305031102.175304001 1 2 3 0 0 0 1\n"
        "1305031102.175304002 1 2 3 0 0 0 1\n"
        "1305031102.5 1 2 3 0 0 0 1\n"
        "1305031103 1 2 3 0 0 0 1\n");
    ASSERT_EQ(poses.size(), 4U);
    EXPECT_EQ(poses[0].time, 1'305'031'102'175'304'001ns);
    EXPECT_EQ(poses[1].time, 1'305'031'102'175'304'002ns);
    EXPECT_EQ(poses[2].time, 1'305'031'102'500'000'000ns);
    EXPECT_EQ(poses[3].time, 1'305'031'103'000'000'000ns);
}

TEST_F(Tum, stampsMayBeNegativeShortOrLong) {
    const auto poses = load(
        "-1.25 0 0 0 0 0 0 1\n"
        "-.25 0 0 0 0 0 0 1\n"
        "0.1234567894 0 0 0 0 0 0 1\n"
        "0.1234567896 0 0 0 0 0 0 1\n"
        "0.9999999999 0 0 0 0 0 0 1\n"
        "7. 0 0 0 0 0 0 1\n");
    ASSERT_EQ(poses.size(), 6U);
    EXPECT_EQ(poses[0].time, -1250ms);
    EXPECT_EQ(poses[1].time, -250ms);
    EXPECT_EQ(poses[2].time, 123456789ns);
    EXPECT_EQ(poses[3].time, 123456790ns);
    EXPECT_EQ(poses[4].time, 1s);
    EXPECT_EQ(poses[5].time, 7s);
}

// What evo writes: numpy's default of eighteen decimals and an exponent.
TEST_F(Tum, stampsMayHaveAnExponent) {
    const auto poses = load(
        "2.500000000000000000e-01 0 0 0 0 0 0 1\n"
        "5E0 0 0 0 0 0 0 1\n"
        "1.25e3 0 0 0 0 0 0 1\n"
        "1.700000000123456716e+09 0 0 0 0 0 0 1\n");
    ASSERT_EQ(poses.size(), 4U);
    EXPECT_EQ(poses[0].time, 250ms);
    EXPECT_EQ(poses[1].time, 5s);
    EXPECT_EQ(poses[2].time, 1250s);
    EXPECT_EQ(poses[3].time, 1700000000s + 123456716ns);
}

TEST_F(Tum, columnsAreTxTyTzQxQyQzQw) {
    const auto poses = load("0 1.5 -2 3e-1 0 0 0.6 0.8\n");
    ASSERT_EQ(poses.size(), 1U);
    EXPECT_EQ(poses[0].pose.translation_m, glm::dvec3(1.5, -2.0, 0.3));
    EXPECT_DOUBLE_EQ(poses[0].pose.rotation.x, 0.0);
    EXPECT_DOUBLE_EQ(poses[0].pose.rotation.y, 0.0);
    EXPECT_DOUBLE_EQ(poses[0].pose.rotation.z, 0.6);
    EXPECT_DOUBLE_EQ(poses[0].pose.rotation.w, 0.8);
}

TEST_F(Tum, quaternionsBecomeUnitLength) {
    const auto poses = load("0 0 0 0 0.71 0 0 -0.71\n1 0 0 0 0 0 0.7 0.7\n");
    ASSERT_EQ(poses.size(), 2U);
    EXPECT_DOUBLE_EQ(poses[0].pose.rotation.x, std::sqrt(0.5));
    EXPECT_DOUBLE_EQ(poses[0].pose.rotation.w, -std::sqrt(0.5));
    EXPECT_DOUBLE_EQ(poses[1].pose.rotation.w, std::sqrt(0.5));
}

// A column read as another, mostly.
TEST_F(Tum, quaternionsOfAnotherLengthAreFaults) {
    const std::string advice = "; divide each by that, or see whether the columns are these";
    const std::string fault = " qx qy qz qw must be a quaternion of length 1, not ";
    EXPECT_THAT(
        faults("0 0 0 0 0 0 0 2\n1 0 0 0 0 0 0 1\n2 0 0 0 0.5 0 0.5 0.65\n"),
        ElementsAre("a.tum:1:" + fault + "2" + advice, "a.tum:3:" + fault + "0.9605" + advice));
}

TEST_F(Tum, marksCommentsBlankLinesAndLineEndsDoNotMatter) {
    const auto poses = load(
        "\xEF\xBB\xBF# a comment\r\n"
        "\r\n"
        "  \t \n"
        "  # one more\n"
        "1\t1  0 0   0 0 0 1 \r\n"
        "2 2 0 0 0 0 0 1");  // no line end
    ASSERT_EQ(poses.size(), 2U);
    EXPECT_EQ(poses[0].pose.translation_m.x, 1.0);
    EXPECT_EQ(poses[1].pose.translation_m.x, 2.0);
}

TEST_F(Tum, everyFaultIsToldWithItsLine) {
    const auto text =
        "0 0 0 0 0 0 0 1\n"
        "# fine\n"
        "1e 0 0 0 0 0 0 1\n"
        "0x10 0 0 0 0 0 0 1\n"
        "1 0 0 0 0 0 1\n"
        "1 0 0 0 0 0 0 1 9\n"
        "1 0 nan 0 0 0 0 1\n"
        "1 0 0 2.5.1 0 0 0 1\n"
        "1 0 0 20000000 0 0 0 1\n"
        "1 0 0 0 0 0 0 0\n"
        "0 0 0 0 0 0 0 1\n"
        "2 0 0 0 0 0 0 1\n"
        "1 0 0 0 0 0 0 1\n"
        "99999999999 0 0 0 0 0 0 1\n";
    const std::string stamp = "t must be seconds as decimals below 9e9, not ";
    const std::string columns = "a pose has 8 columns (t tx ty tz qx qy qz qw), this line has ";
    EXPECT_THAT(
        faults(text),
        ElementsAre("a.tum:3: " + stamp + "'1e'", "a.tum:4: " + stamp + "'0x10'",
                    "a.tum:5: " + columns + "7", "a.tum:6: " + columns + "9",
                    "a.tum:7: ty must be a finite number, not 'nan'",
                    "a.tum:8: tz must be a finite number, not '2.5.1'",
                    "a.tum:9: tx ty tz must lie within 1e7 m of the origin",
                    "a.tum:10: qx qy qz qw must be a quaternion of length 1, not 0; divide each "
                    "by that, or see whether the columns are these",
                    "a.tum:13: t must be later than the pose before it",
                    "a.tum:14: " + stamp + "'99999999999'"));
}

TEST_F(Tum, posesWithTheStampOfTheOneBeforeAreLeftOutAndTold) {
    const auto text =
        "1 1 0 0 0 0 0 1\n"
        "2 2 0 0 0 0 0 1\n"
        "2 3 0 0 0 0 0 1\n"
        "2.0 4 0 0 0 0 0 1\n"
        "3 5 0 0 0 0 0 1\n";
    const auto loaded = load_trajectory(folder_.write("a.tum", text));
    ASSERT_EQ(loaded.poses.size(), 3U);
    EXPECT_EQ(loaded.poses[1].pose.translation_m.x, 2.0);
    EXPECT_EQ(loaded.poses[2].pose.translation_m.x, 5.0);
    EXPECT_THAT(loaded.warnings,
                ElementsAre((folder_.path() / "a.tum").string() +
                            ":3: has the stamp of the pose before it, as 2 lines do; such poses "
                            "are left out"));
    // What goes back is no slip of a recorder: two drives in one file, or one out of order.
    EXPECT_THAT(faults("2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n"),
                ElementsAre("a.tum:2: t must be later than the pose before it"));
}

TEST_F(Tum, stampsLieWithinAHundredYears) {
    EXPECT_EQ(load("-8e9 0 0 0 0 0 0 1\n-3.5e9 0 0 0 0 0 0 1\n").size(), 2U);
    EXPECT_THAT(faults("-8e9 0 0 0 0 0 0 1\n-3499999999 0 0 0 0 0 0 1\n8e9 0 0 0 0 0 0 1\n"),
                ElementsAre("a.tum:2: t must lie within 4.5e9 s of the first one",
                            "a.tum:3: t must lie within 4.5e9 s of the first one"));
}

TEST_F(Tum, aFileThatIsNoTrajectoryDoesNotFloodTheTerminal) {
    std::string text;
    for (int i = 0; i < 250; ++i)
        text += "\x01junk\xFF\n";
    const auto all = faults(text);
    ASSERT_EQ(all.size(), 101U);
    EXPECT_EQ(all.back(), "a.tum: and 150 more");
}

TEST_F(Tum, emptyMissingAndFoldersAreNotTrajectories) {
    EXPECT_THAT(faults(""), ElementsAre("a.tum: holds no pose; a line is t tx ty tz qx qy qz qw"));
    EXPECT_THAT(faults("# nothing\n"),
                ElementsAre("a.tum: holds no pose; a line is t tx ty tz qx qy qz qw"));
    EXPECT_THAT(faults_of([&] { load_trajectory(folder_.path() / "b.tum"); }, folder_),
                ElementsAre("b.tum: no such file; name a trajectory"));
    folder_.write("c/d.tum", "");
    EXPECT_THAT(faults_of([&] { load_trajectory(folder_.path() / "c"); }, folder_),
                ElementsAre("c: is a directory; name a trajectory"));
}

}  // namespace
}  // namespace scipd::sim
