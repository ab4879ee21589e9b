// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/poses/pose_feed.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "daemon/clock/stepped_clock.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/temp_dir.h"
#include "tests/support/udp_sender.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

class PoseFeedTest : public testing::Test {
  protected:
    PoseFeedTest() { clock_.advance_to(10s); }

    std::shared_ptr<PoseFeed> feed(const PoseSource& source, Lockstep* lockstep = nullptr) {
        return make_feed({.executor = io_.get_executor(),
                          .intake = intake_,
                          .clock = clock_,
                          .lockstep = lockstep,
                          .report = [this](const std::string& text) { reports_.push_back(text); }},
                         source, poses_of(source));
    }

    [[nodiscard]] static PlayedPoses poses_of(const PoseSource& source) {
        return source.kind == PoseSource::Kind::file ? read_trajectory(source).poses : nullptr;
    }

    [[nodiscard]] PoseSource udp() const {
        return {.kind = PoseSource::Kind::udp, .address = {"127.0.0.1", sender_.port()}};
    }

    [[nodiscard]] static PoseSource trajectory(const std::filesystem::path& file) {
        PoseSource source;
        source.kind = PoseSource::Kind::file;
        source.file = file;
        return source;
    }

    [[nodiscard]] double robot_x(sim::Time time) const {
        return world_.robot("robot")->at(time).translation_m.x;
    }

    [[nodiscard]] bool taken(std::uint64_t accepted, std::uint64_t refused = 0) {
        return run_until(
            io_, [&] { return intake_.accepted() >= accepted && intake_.refused() >= refused; });
    }

    boost::asio::io_context io_;
    World world_ = wall_world();
    PoseIntake intake_{world_};
    SteppedClock clock_;
    std::vector<std::string> reports_;
    tests::UdpSender sender_;
};

TEST_F(PoseFeedTest, TakesDatagramsOfOneLineOrSeveral) {
    const auto poses = feed(udp());
    poses->serve("robot");
    sender_.send(R"({"xyz":[1,0,0]})");
    ASSERT_TRUE(taken(1));
    EXPECT_DOUBLE_EQ(robot_x(10s), 1.0);
    sender_.send("{\"t\":1,\"xyz\":[2,0,0]}\r\n\n{\"t\":1.5,\"xyz\":[3,0,0]}\n");
    clock_.advance_to(11s);
    ASSERT_TRUE(taken(3));
    EXPECT_DOUBLE_EQ(robot_x(11s), 2.0);
    EXPECT_DOUBLE_EQ(robot_x(11500ms), 3.0);
    EXPECT_TRUE(reports_.empty());
    poses->stop();
}

TEST_F(PoseFeedTest, ReportsTheFirstRefusalAndNotEveryOne) {
    const auto poses = feed(udp());
    poses->serve("robot");
    for (int i = 0; i < 50; ++i)
        sender_.send("rubbish");
    ASSERT_TRUE(taken(0, 50));
    ASSERT_EQ(reports_.size(), 1U);
    EXPECT_EQ(reports_[0].rfind("pose of robot refused: ", 0), 0U) << reports_[0];
    poses->stop();
}

TEST_F(PoseFeedTest, RefusesPosesBeyondTheRateOfASender) {
    LimitValues values;
    values[Limit::poses_per_s] = 100;
    const auto limits = std::make_shared<Limits>(values);
    PoseIntake intake(world_, nullptr, limits);
    const auto poses = make_feed({.executor = io_.get_executor(),
                                  .intake = intake,
                                  .clock = clock_,
                                  .report = [](const std::string&) {}},
                                 udp());
    poses->serve("robot");
    std::string datagram;
    for (int i = 0; i < 10'000; ++i)
        datagram += "0 1 0 0 0 0 0 1\n";
    sender_.send(datagram.substr(0, 60'000 / 16 * 16));
    EXPECT_TRUE(run_until(io_, [&] { return intake.accepted() + intake.refused() == 3750; }));
    EXPECT_GE(limits->refused(Limit::poses_per_s), 1000U);
    EXPECT_TRUE(intake.last_refusal()->find("poses_per_s under limits") != std::string::npos);
    poses->stop();
}

TEST_F(PoseFeedTest, TakesALongDatagramInParts) {
    const auto poses = feed(udp());
    poses->serve("robot");
    std::string datagram;
    for (int i = 0; i < 20'000; ++i)
        datagram += "x\n";
    sender_.send(datagram);
    std::uint64_t most_at_once = 0;
    std::uint64_t before = 0;
    const bool all = run_until(io_, [&] {  // is asked after each handler
        most_at_once = std::max(most_at_once, intake_.refused() - before);
        before = intake_.refused();
        return before == 20'000;
    });
    EXPECT_TRUE(all);
    EXPECT_LE(most_at_once, 100U);
    sender_.send(R"({"xyz":[1,0,0]})");
    EXPECT_TRUE(taken(1));
    poses->stop();
}

TEST_F(PoseFeedTest, LeavesTheRestOfADatagramOnceStopped) {
    const auto poses = feed(udp());
    poses->serve("robot");
    std::string datagram;
    for (int i = 0; i < 20'000; ++i)
        datagram += "x\n";
    sender_.send(datagram);
    ASSERT_TRUE(taken(0, 1));
    poses->stop();
    const std::uint64_t refused = intake_.refused();
    io_.restart();
    io_.run_for(15s);  // far longer than it takes, even on a busy machine
    EXPECT_TRUE(io_.stopped());
    EXPECT_EQ(intake_.refused(), refused);
}

TEST_F(PoseFeedTest, TakesNothingOnceStopped) {
    const auto poses = feed(udp());
    poses->serve("robot");
    poses->stop();
    sender_.send(R"({"xyz":[1,0,0]})");
    io_.run_for(50ms);
    EXPECT_EQ(intake_.accepted(), 0U);
    // The port is free again.
    feed(udp())->stop();
}

// With the first one the second is on its way up already.
TEST_F(PoseFeedTest, EndsWhenItIsStoppedBetweenTwoDatagrams) {
    const auto poses = feed(udp());
    poses->serve("robot");
    sender_.send(R"({"xyz":[1,0,0]})");
    sender_.send(R"({"xyz":[2,0,0]})");
    ASSERT_TRUE(taken(1));
    poses->stop();
    io_.restart();
    io_.run_for(15s);  // far longer than it takes, even on a busy machine
    EXPECT_TRUE(io_.stopped());
    EXPECT_EQ(intake_.accepted(), 1U);
}

/// Puts something else in the place of standard input while it lives.
class StandardInput {
  public:
    explicit StandardInput(const std::filesystem::path& file) {
        const int other = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
        ::dup2(other, STDIN_FILENO);
        ::close(other);
    }
    ~StandardInput() {
        ::dup2(before_, STDIN_FILENO);
        ::close(before_);
    }
    StandardInput(const StandardInput&) = delete;
    StandardInput& operator=(const StandardInput&) = delete;

  private:
    int before_ = ::dup(STDIN_FILENO);
};

TEST_F(PoseFeedTest, TakesNoFileForStandardInputOnTheWallClock) {
    const tests::TempDir directory;
    const StandardInput input(directory.write("drive.tum", "5 1 0 0 0 0 0 1\n"));
    const PoseSource standard_input{.kind = PoseSource::Kind::standard_input};
    try {
        feed(standard_input)->stop();
        FAIL() << "takes it";
    } catch (const std::runtime_error& refusal) {
        EXPECT_THAT(refusal.what(), testing::HasSubstr("--poses FILE"));
    }
}

TEST_F(PoseFeedTest, ReadsAFileAsStandardInputInLockstep) {
    const tests::TempDir directory;
    std::string drive;
    for (int i = 0; i < 5000; ++i)
        drive += std::to_string(i) + " 1 0 0 0 0 0 1\n";
    const StandardInput input(directory.write("drive.tum", drive));
    Lockstep lockstep(io_.get_executor());
    PoseIntake intake(world_, &lockstep);
    const auto poses =
        make_feed({.executor = io_.get_executor(),
                   .intake = intake,
                   .clock = lockstep.clock(),
                   .lockstep = &lockstep,
                   .report = [this](const std::string& text) { reports_.push_back(text); }},
                  {.kind = PoseSource::Kind::standard_input});
    poses->serve("robot");
    ASSERT_TRUE(run_until(io_, [&] { return !reports_.empty(); }));
    EXPECT_EQ(intake.accepted(), 5000U);
    EXPECT_EQ(reports_[0], "standard input has ended: robot stays where its last pose puts it");
    poses->stop();
}

TEST_F(PoseFeedTest, SaysThatAPortIsInUse) {
    const auto first = feed(udp());
    EXPECT_THROW(feed(udp()), std::runtime_error);
    first->stop();
}

TEST_F(PoseFeedTest, PlaysATrajectoryFromTheMomentOfItsStart) {
    const tests::TempDir directory;
    const auto file = directory.write("drive.tum",
                                      "500.0 1 0 0 0 0 0 1\n"
                                      "500.5 2 0 0 0 0 0 1\n"
                                      "503.0 3 0 0 0 0 0 1\n");
    const auto poses = feed(trajectory(file));
    EXPECT_EQ(intake_.accepted(), 0U);
    poses->serve("robot");
    // The sweeps need to know now what lies within the next second and a half.
    EXPECT_EQ(intake_.accepted(), 2U);
    EXPECT_DOUBLE_EQ(robot_x(10s), 1.0);
    EXPECT_DOUBLE_EQ(robot_x(10250ms), 1.5);
    // It goes on twice a second.
    clock_.advance_to(11400ms);
    EXPECT_EQ(intake_.accepted(), 2U);
    clock_.advance_to(12s);
    EXPECT_EQ(intake_.accepted(), 3U);
    EXPECT_DOUBLE_EQ(robot_x(13s), 3.0);
    poses->stop();
}

// Poses as close as these would be handed on for seconds.
TEST_F(PoseFeedTest, PlaysManyPosesAtOneMomentInParts) {
    constexpr int count = 10'000;
    std::string text;
    for (int i = 0; i < count; ++i) {
        const std::string digits = std::to_string(100'000 + i);
        text += "5." + digits + " 1 0 0 0 0 0 1\n";
    }
    const tests::TempDir directory;
    const auto poses = feed(trajectory(directory.write("dense.tum", text)));
    poses->serve("robot");
    EXPECT_LE(intake_.accepted(), 1000U);
    clock_.advance_to(clock_.now());
    EXPECT_EQ(intake_.accepted(), static_cast<std::uint64_t>(count));
    poses->stop();
}

// Fifty robots hand on 5000 poses each half a second; were it at once, sweeps would have to wait.
TEST_F(PoseFeedTest, HandsOnTheTrajectoriesOfManyRobotsOneAfterTheOther) {
    const tests::TempDir directory;
    std::string text;
    for (int i = 0; i < 1000; ++i)
        text += std::to_string(0.01 * i) + " 1 0 0 0 0 0 1\n";
    const auto file = directory.write("drive.tum", text);
    std::map<std::string, RobotStart> robots;
    for (int i = 0; i < 50; ++i)
        robots["robot" + std::to_string(i)] = {};
    world_.set_robots(robots);
    std::vector<std::shared_ptr<PoseFeed>> feeds;
    for (const auto& [robot, start] : robots)
        feeds.emplace_back(feed(trajectory(file)))->serve(robot);
    clock_.advance_to(clock_.now() + 500ms);
    const std::uint64_t begin = intake_.accepted();
    std::uint64_t most = 0;
    for (int i = 0; i < 50; ++i) {
        const std::uint64_t before = intake_.accepted();
        clock_.advance_to(clock_.now() + 20ms);
        most = std::max(most, intake_.accepted() - before);
    }
    EXPECT_NEAR(double(intake_.accepted() - begin), 50 * 100.0, 50 * 2.0);
    EXPECT_LE(most, 500U);
    for (const auto& poses : feeds)
        poses->stop();
}

// Whatever the moment at which its feed goes on.
TEST_F(PoseFeedTest, KnowsAllOfAMovementWhosePosesAreASecondApart) {
    const tests::TempDir directory;
    std::string text;
    for (int i = 0; i < 8; ++i)
        text += std::to_string(0.95 * i) + " " + std::to_string(0.95 * i) + " 0 0 0 0 0 1\n";
    const auto file = directory.write("drive.tum", text);
    for (const char* robot : {"a", "b", "c", "d", "e", "f", "g", "h"}) {
        world_.set_robots({{robot, {}}});
        const sim::Time begin = clock_.now();
        const auto poses = feed(trajectory(file));
        poses->serve(robot);
        for (sim::Time since{}; since < 6s; since += 20ms) {
            clock_.advance_to(begin + since);
            const double x_m = world_.robot(robot)->at(begin + since).translation_m.x;
            ASSERT_NEAR(x_m, std::chrono::duration<double>(since).count(), 1e-9) << robot;
        }
        poses->stop();
    }
}

// One that is made for a configuration that then fails elsewhere never serves.
TEST_F(PoseFeedTest, HoldsTimeBackOnlyFromWhenItServes) {
    const tests::TempDir directory;
    const PoseSource file = trajectory(directory.write("drive.tum", "5 1 0 0 0 0 0 1\n"));
    Lockstep lockstep(io_.get_executor());
    int other = 0;  // its address is a stream
    lockstep.add(&other);
    const auto now_after = [&](sim::Time time) {
        lockstep.come_to(&other, time, true);
        io_.restart();
        io_.run_for(20ms);
        return lockstep.clock().now();
    };
    const auto live = feed(udp(), &lockstep);
    const auto played = feed(file, &lockstep);
    EXPECT_EQ(now_after(1s), 1s);
    live->serve("robot");
    EXPECT_EQ(now_after(2s), 1s);
    live->stop();
    EXPECT_EQ(now_after(3s), 3s);
}

}  // namespace
}  // namespace scipd::daemon
