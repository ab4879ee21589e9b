// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Poses of every form of trajectory but TUM's, checked by hand.
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/poses/trajectory.h"
#include "tests/sim/loaders/faults_of.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using namespace std::chrono_literals;
using Format = TrajectoryFormat;

constexpr double quarter_rad = std::numbers::pi / 2;

void expect_pose(const Pose& pose, const glm::dvec3& xyz_m, const glm::dvec3& rpy_rad) {
    const Pose expected = pose_from_rpy(xyz_m, rpy_rad);
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(pose.translation_m[axis], xyz_m[axis], 1e-9) << axis;
    EXPECT_LT(angle_between_rad(pose.rotation, expected.rotation), 1e-6);
}

class Trajectories : public ::testing::Test {
  protected:
    Trajectory load(std::string_view text, Format format = Format::guess) {
        return load_trajectory(folder_.write("a.txt", text), format);
    }
    std::vector<std::string> faults(std::string_view text, Format format = Format::guess) {
        return faults_of([&] { load(text, format); }, folder_);
    }
    TempDir folder_;
};

TEST_F(Trajectories, areGuessedByTheirFirstLines) {
    EXPECT_EQ(guessed_format("# x\n\n1 2 3 4 5 6 7 8\n"), Format::tum);
    EXPECT_EQ(guessed_format("1 2 3 4 5 6 7 8 9 10 11 12\n"), Format::kitti);
    EXPECT_EQ(guessed_format("#timestamp\n1403636580838555648,1,2,3,1,0,0,0,9\n"), Format::euroc);
    EXPECT_EQ(guessed_format("t,x,y,yaw\n1,2,3,4\n"), Format::csv);
    EXPECT_EQ(guessed_format("\"t\";x;y;yaw\n"), Format::csv);
    EXPECT_EQ(guessed_format("t x y yaw\n"), Format::csv);
    // Its header says that these are in another order.
    EXPECT_EQ(guessed_format("#timestamp,x,y,z,qx,qy,qz,qw\n1403636580838555648,1,2,3,0,0,0,1\n"),
              Format::csv);
    EXPECT_EQ(guessed_format("# t x y z roll pitch yaw v\n1\t2\t3\t4\t5\t6\t7\t8\n"), Format::tum);
    EXPECT_EQ(guessed_format(""), Format::tum);
}

TEST_F(Trajectories, haveOneRotationAndTellWhatElseIsThere) {
    const auto both = load("t,x,y,qx,qy,qz,qw,yaw\n1,2,3,0,0,0,1,0.5\n");
    EXPECT_THAT(both.warnings, ElementsAre(HasSubstr("the column 'yaw' is not read")));
    expect_pose(both.poses[0].pose, {2, 3, 0}, {0, 0, 0});
    const auto part = load("t,x,y,qx,qy,qz,yaw\n1,2,3,0.5,0.5,0.5,0.5\n");
    EXPECT_THAT(part.warnings, ElementsAre(HasSubstr("the columns 'qx', 'qy', 'qz' are not read")));
    expect_pose(part.poses[0].pose, {2, 3, 0}, {0, 0, 0.5});
}

// The first two lines of a recording's ground truth and one that turns by 90 degrees about z.
TEST_F(Trajectories, euroc) {
    const auto loaded = load(
        "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
        "q_RS_z [], v_RS_R_x [m s^-1]\r\n"
        "1403636580838555648,4.688319,-1.786938,0.783338,1,0,0,0,-0.027876\r\n"
        "1403636580843555328,1,2,3,0.7071068,0,0,0.7071068,0.033272\r\n");
    EXPECT_THAT(loaded.warnings, IsEmpty());
    ASSERT_EQ(loaded.poses.size(), 2U);
    EXPECT_EQ(loaded.poses[0].time, 1'403'636'580'838'555'648ns);
    EXPECT_EQ(loaded.poses[1].time, 1'403'636'580'843'555'328ns);
    expect_pose(loaded.poses[0].pose, {4.688319, -1.786938, 0.783338}, {0, 0, 0});
    expect_pose(loaded.poses[1].pose, {1, 2, 3}, {0, 0, quarter_rad});
}

TEST_F(Trajectories, faultsOfEurocNameLineAndColumn) {
    EXPECT_THAT(
        faults("12.5,0,0,0,1,0,0,0\n"
               "1403636580838555648,0,0\n"
               "1403636580838555648,0,up,0,1,0,0,0\n"
               "1403636580838555648,0,0,2e7,1,0,0,0\n"
               "1403636580838555648,0,0,0,0,0,0,0\n",
               Format::euroc),
        ElementsAre("a.txt:1: timestamp must be whole nanoseconds, not '12.5'",
                    "a.txt:2: a pose has 8 columns or more, this line has 3",
                    "a.txt:3: p_y must be a finite number, not 'up'",
                    "a.txt:4: p_x, p_y and p_z must lie within 1e7 m of the origin",
                    "a.txt:5: q_x to q_w must be a quaternion of length 1, not 0; divide each "
                    "by that, or see whether the columns are these"));
}

// A camera looks along z, its x is right and its y is down. It goes ahead by 5 m, up by 1 m and
// right by 2 m, and turns to the right, about its y, by 90 degrees: z becomes the old x.
TEST_F(Trajectories, kittiTurnsTheAxesOfCamerasToThoseOfRobots) {
    const auto loaded = load(
        "1 0 0 0 0 1 0 0 0 0 1 0\n"
        "0 0 1 2.0 0 1 0 -1.0e+00 -1 0 0 5\n"
        // Looks down: about its x, to the right, by -90 degrees; z becomes y.
        "1 0 0 0 0 0 1 0 0 -1 0 0\n");
    EXPECT_THAT(loaded.warnings, IsEmpty());
    ASSERT_EQ(loaded.poses.size(), 3U);
    EXPECT_EQ(loaded.poses[0].time, 0ns);
    EXPECT_EQ(loaded.poses[1].time, 100ms);
    EXPECT_EQ(loaded.poses[2].time, 200ms);
    expect_pose(loaded.poses[0].pose, {0, 0, 0}, {0, 0, 0});
    expect_pose(loaded.poses[1].pose, {5, -2, 1}, {0, 0, -quarter_rad});
    expect_pose(loaded.poses[2].pose, {0, 0, 0}, {0, quarter_rad, 0});
}

TEST_F(Trajectories, kittiHasItsStampsFromAFileBesideItOrNamed) {
    const std::string two = "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n";
    const auto named = folder_.write("b/stamps", "1\n2\n");
    folder_.write("times.txt", "0.000000e+00\n1.037875e-01\n");
    EXPECT_EQ(load(two).poses[1].time, 103'787'500ns);
    const auto file = folder_.path() / "a.txt";
    EXPECT_EQ(load_trajectory(file, Format::kitti, named).poses[1].time, 2s);
    folder_.write("times.txt", "0\n1\n2\n");
    EXPECT_THAT(load(two).warnings, ElementsAre(HasSubstr("has 2 poses, but there are 3 stamps")));
    folder_.write("times.txt", "0\nnoon\n");
    EXPECT_THAT(faults(two), ElementsAre("times.txt:2: a line is the time of a pose in seconds, "
                                         "not 'noon'"));
}

// As of another drive.
TEST_F(Trajectories, stampsThatAreNoneOfAKittiFileAreToldOnce) {
    const std::string pose = "1 0 0 0 0 1 0 0 0 0 1 0\n";
    const std::string four = pose + pose + pose + pose;
    const auto with_stamps = [&](const std::string& text) {
        folder_.write("times.txt", text);
        return faults(four);
    };
    EXPECT_THAT(with_stamps("0\n"),
                ElementsAre("a.txt: has 4 poses, but there is 1 stamp in times.txt; name the file "
                            "of its stamps as `times`"));
    EXPECT_THAT(with_stamps(""), ElementsAre(HasSubstr("there are 0 stamps in times.txt")));
    EXPECT_THAT(with_stamps("9\n\n3\n2\n1\n"),
                ElementsAre("times.txt:3: is earlier than the stamp before it"));
    EXPECT_THAT(with_stamps("0\n5e9\n6e9\n7e9\n"),
                ElementsAre("times.txt:2: must lie within 4.5e9 s of the first stamp"));
    EXPECT_THAT(with_stamps(four),
                ElementsAre(HasSubstr("times.txt:1: a line is the time of a pose in seconds")));
}

TEST_F(Trajectories, aTimesTxtThatIsNoPlainFileIsToldWhereItIsWanted) {
    std::filesystem::create_directory(folder_.path() / "times.txt");
    EXPECT_THAT(faults("1 0 0 0 0 1 0 0 0 0 1 0\n"),
                ElementsAre("times.txt: is a directory; the stamps of a trajectory are wanted"));
    EXPECT_EQ(load("1 1 2 3 0 0 0 1\n").poses.size(), 1U);  // TUM has its own
    std::filesystem::remove(folder_.path() / "times.txt");
    std::filesystem::create_symlink("nowhere", folder_.path() / "times.txt");
    EXPECT_THAT(faults("1 0 0 0 0 1 0 0 0 0 1 0\n"),
                ElementsAre(HasSubstr("times.txt: no such file")));
}

TEST_F(Trajectories, faultsOfKitti) {
    EXPECT_THAT(faults("1 0 0 0 0 1 0 0 0 0 1\n"
                       "1 0 0 0 0 1 0 0 0 0 x 0\n"
                       "2 0 0 0 0 1 0 0 0 0 1 0\n"
                       "-1 0 0 0 0 1 0 0 0 0 1 0\n"
                       "1 0 0 0 0 1 0 0 0 0 1 1e9\n",
                       Format::kitti),
                ElementsAre("a.txt:1: a pose has 12 columns, the rows of [R t], this line has 11",
                            "a.txt:2: r33 must be a finite number, not 'x'",
                            "a.txt:3: r11 to r33 must be a rotation",
                            "a.txt:4: r11 to r33 must be a rotation",
                            "a.txt:5: x, y and z must lie within 1e7 m of the origin"));
}

TEST_F(Trajectories, csvByTheNamesOfItsColumns) {
    const auto loaded = load("theta,y,x,time,speed\n1.5707963,2,1,0.25,9\n0,4,3,0.5,9\n");
    ASSERT_EQ(loaded.poses.size(), 2U);
    EXPECT_EQ(loaded.poses[0].time, 250ms);
    expect_pose(loaded.poses[0].pose, {1, 2, 0}, {0, 0, quarter_rad});
    expect_pose(loaded.poses[1].pose, {3, 4, 0}, {0, 0, 0});
    EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("a.txt: the column 'speed' is not read")));
}

TEST_F(Trajectories, csvWithEveryDelimiterAndOrder) {
    for (const std::string delimiter : {",", ";", "\t", " ", ", "}) {
        const auto row = [&](std::vector<std::string> cells) {
            std::string text;
            for (const auto& cell : cells)
                text += (text.empty() ? "" : delimiter) + cell;
            return text + '\n';
        };
        const auto poses = load(row({"t", "x", "y", "z", "qw", "qx", "qy", "qz"}) +
                                row({"1", "2", "3", "4", "0", "0", "0", "1"}))
                               .poses;
        ASSERT_EQ(poses.size(), 1U) << '"' << delimiter << '"';
        expect_pose(poses[0].pose, {2, 3, 4}, {0, 0, 2 * quarter_rad});
    }
}

TEST_F(Trajectories, csvWithUnits) {
    const auto first = [&](const std::string& text) { return load(text).poses.at(0); };
    EXPECT_EQ(first("t_ms,x,y,yaw\n1500.5,0,0,0\n").time, 1'500'500us);
    EXPECT_EQ(first("timestamp [ns],x,y,yaw\n1700000000123456789,0,0,0\n").time,
              1'700'000'000'123'456'789ns);
    EXPECT_EQ(first("Time (us),x,y,yaw\n12,0,0,0\n").time, 12us);
    // Nobody counts so many seconds.
    EXPECT_EQ(first("timestamp,x,y,yaw\n1700000000123456789,0,0,0\n").time,
              1'700'000'000'123'456'789ns);
    EXPECT_EQ(first("timestamp,x,y,yaw\n1700000000123,0,0,0\n").time, 1'700'000'000'123ms);
    EXPECT_EQ(first("timestamp,x,y,yaw\n1700000000.123456789,0,0,0\n").time,
              1'700'000'000'123'456'789ns);
    expect_pose(first("t,x [m],y,roll_deg,pitch_deg,yaw_deg\n0,0,0,0,-90,0\n").pose, {0, 0, 0},
                {0, -quarter_rad, 0});
}

TEST_F(Trajectories, csvWhoseHeaderIsAComment) {
    const auto poses = load("# made by hand\n# t, x, y, yaw\n0.5,1,2,0\n").poses;
    ASSERT_EQ(poses.size(), 1U);
    expect_pose(poses[0].pose, {1, 2, 0}, {0, 0, 0});
    const auto blank = load("# t x y z roll pitch yaw\n0.5 1 2 0 0 0 0\n", Format::csv).poses;
    ASSERT_EQ(blank.size(), 1U);
    expect_pose(blank[0].pose, {1, 2, 0}, {0, 0, 0});
}

TEST_F(Trajectories, faultsOfCsvNameLineAndColumn) {
    EXPECT_THAT(faults("t,Pos_X,y,Heading\n0,1,2\n1,a,2,3\nnoon,1,2,3\n1,1,2,1e9\n"),
                ElementsAre("a.txt:2: a pose has 4 columns or more, this line has 3",
                            "a.txt:3: Pos_X must be a finite number, not 'a'",
                            "a.txt:4: t must be a time in decimals, below 9e9 s, not 'noon'",
                            "a.txt:5: Heading must lie within 1e6 rad, not '1e9'"));
    EXPECT_THAT(faults("x,y,yaw\n"),
                ElementsAre(HasSubstr("a.txt:1: the header has no column t;")));
    EXPECT_THAT(faults("t,x,y,qx,qy,qz\n"),
                ElementsAre(HasSubstr("a.txt:1: the header has no column yaw, or qx, qy, qz and")));
    EXPECT_THAT(faults("t,x,y,yaw,time\n"),
                ElementsAre("a.txt:1: has two columns for t: 't' and 'time'"));
    EXPECT_THAT(faults("t,x [mm],y,yaw\n"), ElementsAre("a.txt:1: 'x [mm]' must be in metres"));
    EXPECT_THAT(faults("t,x,y,yaw_deg,roll_rad\n"),
                ElementsAre("a.txt:1: 'roll_rad' must have the unit of the other angles"));
    EXPECT_THAT(faults("t,x,y,yaw\n"),
                ElementsAre("a.txt: holds no pose; a line is a row under a header such as "
                            "t,x,y,z,roll,pitch,yaw"));
    // Numbers between commas say nothing of themselves.
    EXPECT_THAT(faults("1,2,3,4\n"),
                ElementsAre(HasSubstr("a.txt:1: the header has no column t;")));
}

TEST_F(Trajectories, repeatedStampsAreLeftOutOfEveryForm) {
    const auto loaded = load("t,x,y,yaw\n1,1,0,0\n1,2,0,0\n2,3,0,0\n");
    EXPECT_EQ(loaded.poses.size(), 2U);
    EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("a.txt:3: has the stamp of the pose before "
                                                       "it, as 1 line does;")));
}

}  // namespace
}  // namespace scipd::sim
