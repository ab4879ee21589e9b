// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <filesystem>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/plan/load_world.h"
#include "sim/loaders/file/load_error.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Key;

constexpr const char* two_poses = "5 1 0 0 0 0 0 1\n6 2 0 0 0 0 0 1\n";

class LoadTrajectoriesTest : public testing::Test {
  protected:
    PoseSource& add(const std::string& robot, const std::filesystem::path& file) {
        RobotConfig plays{.name = robot};
        PoseSource& source = plays.poses.emplace();
        source.kind = PoseSource::Kind::file;
        source.file = file;
        config_.places["robots." + robot + ".poses"] = "rig.yaml: " + robot + ": ";
        config_.robots.push_back(std::move(plays));
        return *config_.robots.back().poses;
    }

    [[nodiscard]] std::vector<std::string> faults(const std::stop_token& stop = {}) const {
        try {
            (void)load_trajectories(config_, {}, stop);
        } catch (const sim::LoadError& error) {
            return error.faults();
        }
        return {};
    }

    tests::TempDir directory_;
    Config config_;
};

TEST_F(LoadTrajectoriesTest, ReadsAFileOnceThatSeveralRobotsPlay) {
    const auto file = directory_.write("drive.tum", two_poses);
    add("a", file);
    add("b", file).speed = 2.0;
    add("c", directory_.write("other.tum", two_poses));
    config_.robots.push_back({.name = "stands"});
    const auto poses = load_trajectories(config_).poses;
    EXPECT_THAT(poses, ElementsAre(Key("a"), Key("b"), Key("c")));
    EXPECT_EQ(poses.at("a"), poses.at("b"));
    EXPECT_NE(poses.at("a"), poses.at("c"));
    EXPECT_EQ(poses.at("a")->at(1).pose.translation_m.x, 2.0);
}

// A reload does not read what has been read.
TEST_F(LoadTrajectoriesTest, LeavesOutWhatIsPlayedAlready) {
    const PoseSource source = add("a", directory_.write("drive.tum", two_poses));
    std::filesystem::remove(source.file);
    EXPECT_THAT(load_trajectories(config_, {{"a", source}}).poses, IsEmpty());
    PoseSource faster = source;
    faster.speed = 2.0;
    EXPECT_THROW((void)load_trajectories(config_, {{"a", faster}}), sim::LoadError);
    EXPECT_THROW((void)load_trajectories(config_, {{"b", source}}), sim::LoadError);
}

TEST_F(LoadTrajectoriesTest, TellsEveryFaultWithItsPlace) {
    add("a", directory_.write("rubbish.tum", "1 2 3\n"));
    add("b", directory_.write("drive.tum", two_poses));
    add("c", directory_.path() / "nowhere.tum");
    EXPECT_THAT(faults(), ElementsAre(HasSubstr("rig.yaml: a: "), HasSubstr("rig.yaml: c: ")));
}

TEST_F(LoadTrajectoriesTest, RefusesAWarningWhereItIsStrict) {
    add("a", directory_.write("drive.tum", "1 1 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n"));
    const auto warning = HasSubstr("drive.tum:2: has the stamp");
    EXPECT_THAT(load_trajectories(config_).warnings, ElementsAre(warning));
    config_.strict = true;
    EXPECT_THAT(faults(), ElementsAre(warning));
}

// The one would go round and round within one moment, the other would go backwards.
TEST_F(LoadTrajectoriesTest, RefusesWhatNobodyCanPlayAtThisSpeed) {
    PoseSource& dwarf = add("dwarf", directory_.write("dwarf.tum",
                                                      "5 1 0 0 0 0 0 1\n"
                                                      "5.0005 2 0 0 0 0 0 1\n"));
    dwarf.loop = true;
    EXPECT_THAT(faults(), IsEmpty());
    dwarf.speed = 1.1;
    EXPECT_THAT(faults(), ElementsAre(HasSubstr("less than a millisecond")));
    dwarf.loop = false;
    EXPECT_THAT(faults(), IsEmpty());

    PoseSource& giant = add("giant", directory_.write("giant.tum",
                                                      "0 1 0 0 0 0 0 1\n"
                                                      "10000000 2 0 0 0 0 0 1\n"));
    giant.speed = 0.006;
    EXPECT_THAT(faults(), IsEmpty());
    giant.speed = 0.004;
    EXPECT_THAT(faults(), ElementsAre(HasSubstr("more than 4e9 s")));
}

TEST_F(LoadTrajectoriesTest, ReadsNothingMoreWhenNobodyWaits) {
    add("a", directory_.write("drive.tum", two_poses));
    std::stop_source nobody;
    nobody.request_stop();
    EXPECT_THAT(faults(nobody.get_token()), ElementsAre(HasSubstr("scipd ends")));
}

}  // namespace
}  // namespace scipd::daemon
