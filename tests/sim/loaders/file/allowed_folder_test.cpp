// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/allowed_folder.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

/// home/worlds is allowed; home/worlds2 and home/secret are not.
class AllowedFolder : public testing::Test {
  protected:
    AllowedFolder() {
        dir_.write("home/worlds/room.sdf", "");
        dir_.write("home/worlds/models/box.stl", "");
        dir_.write("home/worlds2/room.sdf", "");
        dir_.write("home/secret/room.sdf", "");
        fs::create_symlink("../secret", worlds_ / "way_out");
        fs::create_symlink("../secret/room.sdf", worlds_ / "out.sdf");
        fs::create_symlink("room.sdf", worlds_ / "same.sdf");
        fs::create_symlink("worlds", home_ / "link_to_worlds");
    }

    [[nodiscard]] bool lies(const fs::path& file) const { return lies_in_one_of({worlds_}, file); }

    tests::TempDir dir_;
    const fs::path home_ = dir_.path() / "home";
    const fs::path worlds_ = home_ / "worlds";
};

TEST_F(AllowedFolder, HasWhatLiesInIt) {
    EXPECT_TRUE(lies(worlds_));
    for (const char* file : {"room.sdf", "models/box.stl", "models/../room.sdf", "same.sdf",
                             "../worlds/room.sdf", "no/such/file", "../link_to_worlds/room.sdf"}) {
        EXPECT_TRUE(lies(worlds_ / file)) << file;
    }
    EXPECT_TRUE(lies_in_one_of({home_ / "secret", home_ / "link_to_worlds"}, worlds_ / "room.sdf"));
    EXPECT_TRUE(lies_in_one_of({"/"}, worlds_ / "room.sdf"));
}

TEST_F(AllowedFolder, HasNothingThatLinksAndDotsLeadTo) {
    for (const char* file : {"..", "../secret/room.sdf", "../worlds2/room.sdf", "way_out",
                             "way_out/room.sdf", "way_out/no such file", "out.sdf",
                             "models/../../secret/room.sdf", "no/../../secret/room.sdf"}) {
        EXPECT_FALSE(lies(worlds_ / file)) << file;
    }
    EXPECT_FALSE(lies("/etc/passwd"));
    EXPECT_FALSE(lies_in_one_of({}, worlds_ / "room.sdf"));
    EXPECT_FALSE(lies_in_one_of({home_ / "no_folder"}, home_ / "no_folder" / "room.sdf"));
}

// Within the folder a link is followed where the kernel follows it: before the "..".
TEST_F(AllowedFolder, FollowsALinkBeforeTheDotsBehindIt) {
    EXPECT_FALSE(lies(worlds_ / "way_out/../worlds2/room.sdf"));
    EXPECT_TRUE(lies(worlds_ / "way_out/../worlds/room.sdf"));
}

}  // namespace
}  // namespace scipd::sim
