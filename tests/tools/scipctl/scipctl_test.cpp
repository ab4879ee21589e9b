// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <chrono>
#include <cmath>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/support/child.h"
#include "tests/support/temp_dir.h"
#include "tests/tools/scipctl/control_stand_in.h"

namespace scipd::tests {
namespace {

using namespace std::chrono_literals;
using testing::ContainsRegex;
using testing::HasSubstr;

std::vector<std::string> scipctl(const ControlStandIn& daemon, std::vector<std::string> words) {
    words.insert(words.begin(), {SCIPCTL, "--control", daemon.socket()});
    return words;
}

Outcome run_scipctl(const ControlStandIn& daemon, const std::vector<std::string>& words,
                    const std::string& input = {}) {
    return run(scipctl(daemon, words), input);
}

TEST(Scipctl, ShowsTheStatus) {
    const ControlStandIn daemon({"rescue"});
    const Outcome outcome = run_scipctl(daemon, {"status"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("scene   maze.sdf\n"));
    EXPECT_THAT(outcome.out, HasSubstr("clock   wall, 12.35 s; up for 90.00 s\n"));
    EXPECT_THAT(outcome.out,
                HasSubstr("poses   7 accepted, 1 refused (the last: xyz is missing)\n"));
    EXPECT_THAT(outcome.out,
                HasSubstr("rescue/front  UST-10LX  embree   streaming  cut, stall  1        4000   "
                          "2     3            - / - / -            127.0.0.1:10940  -\n"));
    EXPECT_THAT(outcome.out, HasSubstr("rescue/front: client from 127.0.0.1:49160 waits until "
                                       "127.0.0.1:49152 disconnects: "));
}

TEST(Scipctl, HandsTheStatusOnAsItIs) {
    const ControlStandIn daemon({"rescue"});
    const auto status = nlohmann::json::parse(run_scipctl(daemon, {"status", "--json"}).out);
    EXPECT_EQ(status["scene"], "maze.sdf");
    EXPECT_EQ(status["sensors"][0]["scans"], 4000);
    const auto sensors = nlohmann::json::parse(run_scipctl(daemon, {"sensors", "--json"}).out);
    EXPECT_EQ(sensors, status["sensors"]);
}

TEST(Scipctl, ListsNamesAlone) {
    const ControlStandIn daemon({"rescue", "scout"});
    EXPECT_EQ(run_scipctl(daemon, {"sensors", "--names"}).out, "rescue/front\nscout/front\n");
    EXPECT_EQ(run_scipctl(daemon, {"sensors", "--robots"}).out, "rescue\nscout\n");
    EXPECT_EQ(run_scipctl(daemon, {"scene", "list", "--names"}).out, "model 0\nmodel 1\n");
}

TEST(Scipctl, WarnsOfDegrees) {
    const ControlStandIn daemon({"rescue"});
    const std::string warning =
        "warning: 90 looks like degrees, but angles are radians; did you mean 1.5708?\n";
    const Outcome set = run_scipctl(daemon, {"pose", "set", "1,2,90"});
    EXPECT_EQ(set.exit_code, 0);
    EXPECT_EQ(set.err, warning);
    EXPECT_EQ(run_scipctl(daemon, {"scene", "move", "model 1", "1,2,90"}).err, warning);
    EXPECT_EQ(run_scipctl(daemon, {"pose", "set", "1,2,0,0,0,1.57"}).err, "");
}

TEST(Scipctl, TellsItsVersion) {
    const Outcome outcome = run({SCIPCTL, "--version"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out, "scipctl " SCIPD_VERSION "\n");
}

TEST(Scipctl, NamesWhatSomebodyMeant) {
    const auto refused = [](std::vector<std::string> words) {
        words.insert(words.begin(), SCIPCTL);
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.exit_code, 2);
        return outcome.err;
    };
    EXPECT_EQ(refused({"statsu"}).substr(0, 62),
              "scipctl: there is no command \"statsu\"; did you mean status? Th");
    EXPECT_EQ(refused({"pose", "play", "/dev/null", "--sped", "2"}),
              "scipctl: there is no option --sped; did you mean --speed? (see scipctl --help)\n");
    EXPECT_EQ(
        refused({"status", "--cotnrol", "x"}),
        "scipctl: there is no option --cotnrol; did you mean --control? (see scipctl --help)\n");
    EXPECT_EQ(refused({"--radar"}), "scipctl: there is no option --radar (see scipctl --help)\n");
}

TEST(Scipctl, KeepsWhatWouldDoHarmFromTheTerminal) {
    const std::string name = "evil\x1b[2J\nname\xc2\x9b";
    const ControlStandIn daemon({name});
    const Outcome shown = run_scipctl(daemon, {"status"});
    EXPECT_THAT(shown.out, HasSubstr("evil\\x1b[2J name\\xc2\\x9b/front  UST-10LX"));
    const Outcome refused = run_scipctl(daemon, {"truth", "no\x1b[2Jbody/x"});
    EXPECT_NE(refused.exit_code, 0);
    EXPECT_THAT(refused.err, HasSubstr("no\\x1b[2Jbody"));
    const Outcome json = run_scipctl(daemon, {"sensors", "--json"});
    EXPECT_EQ(nlohmann::json::parse(json.out)[0]["name"], name + "/front");
    for (const std::string& text : {shown.out, refused.err, json.out}) {
        EXPECT_EQ(text.find('\x1b'), text.npos);
        EXPECT_EQ(text.find('\x9b'), text.npos);
    }
}

TEST(Scipctl, SetsAndGetsAPose) {
    const ControlStandIn daemon({"rescue"});
    Outcome outcome = run_scipctl(daemon, {"pose", "set", "-1.5,2,1.25"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    ASSERT_EQ(daemon.puts().size(), 1U);
    const Put put = daemon.puts().front();
    EXPECT_EQ(put.robot, "rescue");
    EXPECT_FALSE(put.time);
    EXPECT_EQ(put.pose.translation_m, glm::dvec3(-1.5, 2.0, 0.0));
    EXPECT_NEAR(put.pose.rotation.w, std::cos(1.25 / 2), 1e-12);
    EXPECT_NEAR(put.pose.rotation.z, std::sin(1.25 / 2), 1e-12);

    outcome = run_scipctl(daemon, {"pose", "get"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "-1.5,2,0,0,0,1.25\n");
}

// Quaternion by hand: half angles of 0.1, 0.2 and 0.3, rotated about x, then y, then z.
TEST(Scipctl, ReadsAllSixNumbersAndWritesThemBack) {
    const ControlStandIn daemon({"rescue"});
    ASSERT_EQ(run_scipctl(daemon, {"pose", "set", "rescue", "1,2,3,0.2,0.4,0.6"}).exit_code, 0);
    const glm::dquat q = daemon.puts().front().pose.rotation;
    const double cr = std::cos(0.1), sr = std::sin(0.1);
    const double cp = std::cos(0.2), sp = std::sin(0.2);
    const double cy = std::cos(0.3), sy = std::sin(0.3);
    EXPECT_NEAR(q.w, cr * cp * cy + sr * sp * sy, 1e-12);
    EXPECT_NEAR(q.x, sr * cp * cy - cr * sp * sy, 1e-12);
    EXPECT_NEAR(q.y, cr * sp * cy + sr * cp * sy, 1e-12);
    EXPECT_NEAR(q.z, cr * cp * sy - sr * sp * cy, 1e-12);
    EXPECT_EQ(run_scipctl(daemon, {"pose", "get", "rescue"}).out, "1,2,3,0.2,0.4,0.6\n");
}

TEST(Scipctl, TellsWhatComesFromEachSourceOfPoses) {
    const ControlStandIn daemon({"rescue"});
    const Outcome outcome = run_scipctl(daemon, {"pose", "sources"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, ContainsRegex("rescue +ros2:/odm +nav_msgs/Odometry +1200 +3 +0 +50.0 "
                                           "+0.0 s ago +4.3 / 11.5"));
    EXPECT_THAT(outcome.out, ContainsRegex("other +udp:127.0.0.1:14550 +- +0 +0 +0 +0.0 +- +-"));
    EXPECT_THAT(outcome.out,
                HasSubstr("warning: rescue: no publisher of /odm; did you mean '/odom'?\n"));
    const auto said = nlohmann::json::parse(run_scipctl(daemon, {"pose", "sources", "--json"}).out);
    EXPECT_EQ(said.at("sources").at(0).at("messages"), 1200);
}

TEST(Scipctl, AsksWhichRobotWhereThereAreSeveral) {
    const ControlStandIn daemon({"left", "right"});
    Outcome outcome = run_scipctl(daemon, {"pose", "set", "1,2,0"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.err, "scipctl: there are several robots; name one of left, right\n");
    outcome = run_scipctl(daemon, {"pose", "set", "right", "1,2,0"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    ASSERT_EQ(daemon.puts().size(), 1U);
    EXPECT_EQ(daemon.puts().front().robot, "right");
}

TEST(Scipctl, TellsWhatTheDaemonRefuses) {
    const ControlStandIn daemon({"rescue"});
    Outcome outcome = run_scipctl(daemon, {"pose", "get", "nobody"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.err, "scipctl: there is no robot \"nobody\"; there are: rescue\n");
    outcome = run_scipctl(daemon, {"pose", "set", "2000,0,0"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.err, "scipctl: that is outside the world\n");
}

TEST(Scipctl, SaysHowAPoseIsWritten) {
    const ControlStandIn daemon({"cart", "rescue"});
    Outcome outcome = run_scipctl(daemon, {"pose", "set", "1", "-2", "0"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err, "scipctl: write the pose as one word: 1,-2,0\n");
    outcome = run_scipctl(daemon, {"pose", "set", "rescue", "1", "2", "0"});
    EXPECT_EQ(outcome.err, "scipctl: write the pose as one word: 1,2,0\n");
    const std::string no_robot = "scipctl: there is no robot \"robt\"; there are: cart, rescue\n";
    EXPECT_EQ(run_scipctl(daemon, {"pose", "set", "robt", "1,2,0"}).err, no_robot);
    EXPECT_EQ(run_scipctl(daemon, {"pose", "set", "robt"}).err, no_robot);
    EXPECT_EQ(run_scipctl(daemon, {"pose", "set", "cart"}).err,
              "scipctl: add the pose of cart, such as 1,2,0\n");
    EXPECT_TRUE(daemon.puts().empty());
}

TEST(Scipctl, TellsThatNobodyListens) {
    const Outcome outcome = run({SCIPCTL, "--control", "/no/such.sock", "status"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.err,
              "scipctl: cannot reach scipd at /no/such.sock: No such file or directory (does it "
              "run? --control names another socket)\n");
}

TEST(Scipctl, EndsWithTwoForWrongOptions) {
    const ControlStandIn daemon({"rescue"});
    for (const std::string pose : {"1,2", "1,2,3,4", "1,2,x", "1,2,3,", "nan,0,0", ""}) {
        const Outcome outcome = run_scipctl(daemon, {"pose", "set", pose});
        EXPECT_EQ(outcome.exit_code, 2) << pose;
        EXPECT_THAT(outcome.err, HasSubstr("is no pose: write X,Y,YAW or X,Y,Z,R,P,Y"));
    }
    for (const std::string number : {"nan", "inf", "-inf", "1e9", "0x", "many"}) {
        const Outcome played =
            run_scipctl(daemon, {"pose", "play", "/dev/null", "--speed=" + number});
        EXPECT_EQ(played.exit_code, 2) << number;
        EXPECT_THAT(played.err, HasSubstr("--speed: must be a number from 0.001 to 1000"));
        const Outcome added = run_scipctl(daemon, {"scene", "add", "x", "-", "--scale=" + number});
        EXPECT_EQ(added.exit_code, 2) << number;
        EXPECT_THAT(added.err, HasSubstr("--scale: must be a number from -1e+06 to 1e+06"));
    }
    EXPECT_EQ(run_scipctl(daemon, {"dance"}).exit_code, 2);
    EXPECT_EQ(run_scipctl(daemon, {"pose", "play", "/no/such.tum"}).exit_code, 2);
    EXPECT_TRUE(daemon.puts().empty());
}

TEST(Scipctl, PlaysATrajectory) {
    const ControlStandIn daemon({"rescue"});
    const TempDir directory;
    const auto file = directory.write("lap.tum",
                                      "# t x y z qx qy qz qw\n"
                                      "100.0 1 0 0 0 0 0 1\n"
                                      "100.5 2 0 0 0 0 0 1\n"
                                      "101.5 3 0 0 0 0 1 0\n");
    const auto before = std::chrono::steady_clock::now();
    const Outcome outcome = run_scipctl(daemon, {"pose", "play", file, "--speed", "10"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_GE(std::chrono::steady_clock::now() - before, 150ms);

    const auto puts = daemon.puts();
    ASSERT_EQ(puts.size(), 3U);
    for (std::size_t i = 0; i < puts.size(); ++i)
        EXPECT_EQ(puts[i].pose.translation_m.x, static_cast<double>(i) + 1.0);
    // The stamps keep the spacing of the file, ten times as fast; a double holds them to 1 us.
    EXPECT_NEAR(std::chrono::duration<double>(*puts[1].time - *puts[0].time).count(), 0.05, 2e-6);
    EXPECT_NEAR(std::chrono::duration<double>(*puts[2].time - *puts[0].time).count(), 0.15, 2e-6);
}

TEST(Scipctl, PlaysATrajectoryOfAnyFormAndTellsWhatItLeavesOut) {
    const ControlStandIn daemon({"rescue"});
    const TempDir directory;
    const auto file = directory.write("lap.csv",
                                      "time_ms,x,y,theta,v\n"
                                      "100,1,0,0,5\n"
                                      "100,9,0,0,5\n"
                                      "101,2,0,0,5\n");
    const Outcome outcome = run_scipctl(daemon, {"pose", "play", file});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("the column 'v' is not read\n"));
    EXPECT_THAT(outcome.err, HasSubstr("lap.csv:3: has the stamp of the pose before it"));
    const auto puts = daemon.puts();
    ASSERT_EQ(puts.size(), 2U);
    EXPECT_EQ(puts[1].pose.translation_m.x, 2.0);
}

TEST(Scipctl, PlaysInLockstepWithTheFilesOwnStamps) {
    const ControlStandIn daemon({"rescue"}, "poses");
    const TempDir directory;
    const auto file = directory.write("lap.tum", "100.0 1 0 0 0 0 0 1\n100.001 2 0 0 0 0 0 1\n");
    ASSERT_EQ(run_scipctl(daemon, {"pose", "play", file}).exit_code, 0);
    const auto puts = daemon.puts();
    ASSERT_EQ(puts.size(), 2U);
    EXPECT_NEAR(std::chrono::duration<double>(*puts[0].time).count(), 100.0, 1e-9);
    EXPECT_NEAR(std::chrono::duration<double>(*puts[1].time).count(), 100.001, 1e-9);
}

TEST(Scipctl, PlaysInALoop) {
    const ControlStandIn daemon({"rescue"}, "poses");
    const TempDir directory;
    const auto file = directory.write("lap.tum", "0.0 1 0 0 0 0 0 1\n0.01 2 0 0 0 0 0 1\n");
    Child child(scipctl(daemon, {"pose", "play", file, "--loop"}));
    while (daemon.puts().size() < 6)
        std::this_thread::sleep_for(5ms);
    child.signal(SIGTERM);
    (void)child.wait();
    const auto puts = daemon.puts();
    for (std::size_t i = 1; i < puts.size(); ++i) {
        EXPECT_EQ(puts[i].pose.translation_m.x, i % 2 == 0 ? 1.0 : 2.0);
        EXPECT_EQ(*puts[i].time - *puts[i - 1].time, 10ms);
    }
}

// As scipd does that is given the file: from the last pose to the first in the time of the last
// step. Steps of 10 and 30 ms.
TEST(Scipctl, ClosesALoopInTheTimeOfTheLastStep) {
    const ControlStandIn daemon({"rescue"}, "poses");
    const TempDir directory;
    const auto file =
        directory.write("lap.tum", "5 1 0 0 0 0 0 1\n5.01 2 0 0 0 0 0 1\n5.04 3 0 0 0 0 0 1\n");
    Child child(scipctl(daemon, {"pose", "play", file, "--loop"}));
    while (daemon.puts().size() < 7)
        std::this_thread::sleep_for(5ms);
    child.signal(SIGTERM);
    (void)child.wait();
    const auto puts = daemon.puts();
    for (const std::size_t first : {3U, 6U}) {
        EXPECT_EQ(puts[first].pose.translation_m.x, 1.0);
        EXPECT_EQ(*puts[first].time - *puts[first - 1].time, 30ms);
    }
}

TEST(Scipctl, PlaysOnePoseOnceThoughInALoop) {
    const ControlStandIn daemon({"rescue"});
    const TempDir directory;
    const auto file = directory.write("here.tum", "5 1 0 0 0 0 0 1\n");
    EXPECT_EQ(run_scipctl(daemon, {"pose", "play", file, "--loop"}).exit_code, 0);
    EXPECT_EQ(daemon.puts().size(), 1U);
}

TEST(Scipctl, ForwardsAStream) {
    const ControlStandIn daemon({"left", "right"});
    const Outcome outcome = run_scipctl(daemon, {"pose", "stream", "--robot", "left"},
                                        R"({"robot":"right","t":12.5,"xyz":[1,2,3],"q":[0,0,0,1]})"
                                        "\n\n"
                                        R"({"xyz":[4,5,6],"rpy":[0,0,0]})"
                                        "\n1.5 7 8 9 0 0 0 1\n");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto puts = daemon.puts();
    ASSERT_EQ(puts.size(), 3U);
    EXPECT_EQ(puts[0].robot, "right");
    EXPECT_EQ(*puts[0].time, 12500ms);
    EXPECT_EQ(puts[1].robot, "left");
    EXPECT_FALSE(puts[1].time);
    EXPECT_EQ(puts[1].pose.translation_m, glm::dvec3(4, 5, 6));
    EXPECT_EQ(puts[2].robot, "left");
    EXPECT_EQ(*puts[2].time, 1500ms);
}

TEST(Scipctl, ForwardsVelocitiesAndPassesOverComments) {
    const ControlStandIn daemon({"rescue"});
    const Outcome outcome = run_scipctl(daemon, {"pose", "stream"},
                                        "# t x y z qx qy qz qw\n"
                                        R"({"t":1,"xyz":[1,2,3],"v":[1,2,3],"w":[0,0,0.5]})"
                                        "\n  # half way\r\n"
                                        R"({"model":"model 1","t":1,"xyz":[0,0,0],"w":[4,5,6]})"
                                        "\n2 7 8 9 0 0 0 1\n");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto puts = daemon.puts();
    ASSERT_EQ(puts.size(), 3U);
    EXPECT_EQ(puts[0].velocity, (sim::Velocity{{1, 2, 3}, {0, 0, 0.5}}));
    EXPECT_EQ(puts[1].velocity, (sim::Velocity{{0, 0, 0}, {4, 5, 6}}));
    EXPECT_EQ(puts[2].velocity, std::nullopt);
}

TEST(Scipctl, GoesOnAfterALineThatIsRefused) {
    const ControlStandIn daemon({"rescue"});
    const Outcome outcome = run_scipctl(daemon, {"pose", "stream"},
                                        R"({"t":1})"
                                        "\n"
                                        R"({"xyz":[5000,0,0]})"
                                        "\n"
                                        R"({"xyz":[1,0,0]})"
                                        "\n");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.err,
              "line 1: xyz is missing\n"
              "line 2: that is outside the world\n"
              "scipctl: 2 of 3 lines were refused\n");
    EXPECT_EQ(daemon.puts().size(), 1U);
}

}  // namespace
}  // namespace scipd::tests
