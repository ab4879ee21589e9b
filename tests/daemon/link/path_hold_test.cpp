// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/path_hold.h"

#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class PathHoldTest : public testing::Test {
  protected:
    [[nodiscard]] std::string refusal() const {
        try {
            const PathHold hold(path_);
            return "";
        } catch (const PathHeld& error) {
            return error.what();
        }
    }

    /// The signal that ended another process, which held the path.
    [[nodiscard]] int killed_with_hold() const {
        const pid_t child = ::fork();
        if (child == 0) {
            const PathHold hold(path_);
            ::kill(::getpid(), SIGKILL);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    }

    tests::TempDir directory_;
    fs::path path_ = directory_.path() / "urg";
    fs::path lock_ = directory_.path() / ".urg.lock";
};

TEST_F(PathHoldTest, HoldsUntilItEndsAndLeavesNothing) {
    std::optional<PathHold> first(path_);
    EXPECT_EQ(refusal(),
              path_.string() + " is used by this scipd for something else; choose another path");
    EXPECT_EQ(refusal().empty(), false);  // being refused has released nothing
    const PathHold other(directory_.path() / "other");
    first.reset();
    EXPECT_FALSE(fs::exists(lock_));
    EXPECT_EQ(refusal(), "");
}

TEST_F(PathHoldTest, TakesOverFromOneThatWasKilled) {
    ASSERT_EQ(killed_with_hold(), SIGKILL);
    EXPECT_TRUE(fs::exists(lock_));
    EXPECT_EQ(refusal(), "");
}

TEST_F(PathHoldTest, LetsNobodyElseOpenItsLock) {
    const PathHold hold(path_);
    EXPECT_EQ(fs::status(lock_).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

// Its end leaves the lock of a later one alone.
TEST_F(PathHoldTest, RemovesOnlyItsOwnLock) {
    std::optional<PathHold> first(path_);
    fs::remove(lock_);
    const PathHold second(path_);
    first.reset();
    EXPECT_THAT(refusal(), HasSubstr("is used by this scipd"));
}

TEST_F(PathHoldTest, RefusesWhatIsNoLockOfItsOwnAndLeavesItAlone) {
    const fs::path file = directory_.write("file", "precious");
    const auto refuses = [&] {
        EXPECT_THAT(refusal(), HasSubstr(lock_.string() + " is there and is no lock of scipd's"));
        fs::remove(lock_);
        return fs::file_size(file) == 8;
    };
    fs::create_symlink(file, lock_);
    EXPECT_TRUE(refuses());
    fs::create_hard_link(file, lock_);
    EXPECT_TRUE(refuses());
    fs::create_directory(lock_);
    EXPECT_TRUE(refuses());
}

TEST_F(PathHoldTest, NamesTheOtherUserWhoHasThePath) {
    if (::geteuid() != 0) GTEST_SKIP() << "only root can give a file to another user";
    directory_.write(".urg.lock", "");
    ASSERT_EQ(::chown(lock_.c_str(), 54321, 54321), 0);
    EXPECT_EQ(refusal(), path_.string() + " is kept by user 54321, who owns " + lock_.string() +
                             "; choose another path, or have that file removed");
}

TEST_F(PathHoldTest, SaysWhereNoFileCanBeMade) {
    EXPECT_THROW(PathHold{directory_.path() / "missing" / "urg"}, std::system_error);
}

}  // namespace
}  // namespace scipd::daemon
