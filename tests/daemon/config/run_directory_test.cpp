// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/run_directory.h"

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

TEST(RunDirectory, TakesTheFirstThatIsSet) {
    setenv("RUNTIME_DIRECTORY", "/run/scipd:/run/more", 1);
    setenv("XDG_RUNTIME_DIR", "/run/user/7", 1);
    EXPECT_EQ(run_directory(), "/run/scipd");
    setenv("RUNTIME_DIRECTORY", "", 1);
    EXPECT_EQ(run_directory(), "/run/user/7/scipd");
    unsetenv("RUNTIME_DIRECTORY");
    EXPECT_EQ(run_directory(), "/run/user/7/scipd");
    unsetenv("XDG_RUNTIME_DIR");
    EXPECT_EQ(run_directory(), "/tmp/scipd-" + std::to_string(getuid()));
}

std::string refusal(const fs::path& folder) {
    try {
        make_private_folder(folder);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "none";
}

TEST(RunDirectory, IsForThisUserAloneWhereOthersCouldBeFirst) {
    const tests::TempDir directory;
    const fs::path folder = directory.path() / "scipd-7";
    const fs::path link = directory.path() / "link";
    umask(0);
    EXPECT_EQ(refusal(folder), "none");
    EXPECT_EQ(fs::status(folder).permissions(), fs::perms::owner_all);
    EXPECT_EQ(refusal(folder), "none");

    fs::permissions(folder, fs::perms::group_exec, fs::perm_options::add);
    EXPECT_THAT(refusal(folder), HasSubstr("must be for this user alone; chmod 700 it"));
    fs::permissions(folder, fs::perms::owner_all);
    fs::create_directory_symlink(folder, link);
    EXPECT_THAT(refusal(link), HasSubstr("is no folder of this user; set XDG_RUNTIME_DIR"));
    EXPECT_THAT(refusal(directory.write("file", "")), HasSubstr("is no folder of this user"));
    EXPECT_THAT(refusal(directory.path() / "no" / "folder"), HasSubstr("cannot make the folder"));
    // Needs the right to give things away.
    if (::chown(folder.c_str(), ::geteuid() + 1, -1) == 0) {
        EXPECT_THAT(refusal(folder), HasSubstr("is no folder of this user"));
    }
}

TEST(RunDirectory, IsMadeForThisUserAlone) {
    const tests::TempDir directory;
    setenv("XDG_RUNTIME_DIR", directory.path().c_str(), 1);
    umask(0);
    EXPECT_EQ(make_run_directory(), directory.path() / "scipd");
    EXPECT_EQ(fs::status(directory.path() / "scipd").permissions(), fs::perms::owner_all);
    // What somebody has chosen is as he likes it.
    fs::permissions(directory.path() / "scipd", fs::perms::all);
    EXPECT_EQ(make_run_directory(), directory.path() / "scipd");
    unsetenv("XDG_RUNTIME_DIR");
}

}  // namespace
}  // namespace scipd::daemon
