// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scipd for a test ends: with the test however that ends, by a crash, and alone.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "testing/scipd_test.h"
#include "tests/testing/room.h"

namespace {

using namespace scipd::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using Ending = ScipdTest;

bool runs(int process) {
    return ::kill(process, 0) == 0;
}

/// Whether something comes true long before anybody loses patience.
bool comes_true(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
}

TEST_F(Ending, LeavesNothingBehind) {
    Scipd& scipd = start({.world = room});
    const int process = scipd.pid();
    const auto folder = scipd.control().parent_path();
    EXPECT_TRUE(runs(process) && exists(folder));
    scipd.close();
    EXPECT_FALSE(runs(process));
    EXPECT_FALSE(exists(folder));
    EXPECT_EQ(scipd.exit_code(), 0);
    EXPECT_THAT(scipd.log(), HasSubstr("stopped (SIGTERM)"));
    EXPECT_THROW((void)scipd.robot().pose(), ScipdEnded);
    scipd.close();
}

TEST_F(Ending, ByACrashIsToldToWhoeverAsksNext) {
    Scipd& scipd = start({.world = room});
    ::kill(scipd.pid(), SIGABRT);  // which no sanitizer takes for a fault of its own
    try {
        (void)scipd.scan();
        ADD_FAILURE() << "it has sent a scan";
    } catch (const ScipdEnded& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("was ended by signal 6"),
                                        HasSubstr("The end of its log:"), HasSubstr("info")));
    }
    EXPECT_EQ(scipd.exit_code(), -SIGABRT);
}

TEST_F(Ending, ByACrashThatNobodyNoticedIsToldAtTheEnd) {
    Scipd& scipd = start({.world = room});
    const int process = scipd.pid();
    ::kill(process, SIGABRT);
    ASSERT_TRUE(comes_true([&] { return !runs(process); }));
    EXPECT_THROW(scipd.close(), ScipdEnded);
}

TEST_F(Ending, SparesOthers) {
    Scipd& one = start({.world = room});
    Scipd& other = start({.world = room});
    EXPECT_NE(one.port(), other.port());
    one.close();
    EXPECT_NO_THROW((void)other.robot().pose());
}

TEST_F(Ending, OfTheThreadThatStartedItIsNotItsEnd) {
    Scipd* scipd = nullptr;
    std::thread([&] { scipd = &start({.world = room}); }).join();
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    EXPECT_FALSE(scipd->exit_code());
    EXPECT_NO_THROW((void)scipd->robot().pose());
}

TEST_F(Ending, IsNotForWhatTheTestForks) {
    Scipd& scipd = start({.world = room});
    const pid_t child = ::fork();
    if (child == 0) {
        try {
            scipd.close();
        } catch (const ScipdError&) {
        }
        ::_exit(0);
    }
    ::waitpid(child, nullptr, 0);
    EXPECT_NO_THROW((void)scipd.robot().pose());
}

struct Left {
    int process = 0;
    char folder[100]{};
};

/// A process that starts a scipd and then ends so. Returns what it has left to others to remove.
Left ended_by(const std::function<void()>& end) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t test = ::fork();
    if (test == 0) {
        Scipd scipd({.world = room});
        Left left{.process = scipd.pid()};
        scipd.control().parent_path().string().copy(left.folder, sizeof(left.folder) - 1);
        EXPECT_EQ(::write(ends[1], &left, sizeof(left)), ssize_t{sizeof(left)});
        end();
    }
    Left left;
    EXPECT_EQ(::read(ends[0], &left, sizeof(left)), ssize_t{sizeof(left)});
    ::waitpid(test, nullptr, 0);
    ::close(ends[0]);
    ::close(ends[1]);
    return left;
}

void expect_nothing_of(const Left& left) {
    EXPECT_GT(left.process, 0);
    EXPECT_TRUE(comes_true([&] { return !runs(left.process); })) << "scipd lives on";
    EXPECT_TRUE(comes_true([&] { return !std::filesystem::exists(left.folder); }))
        << left.folder << " is left";
}

TEST(EndOfATest, IsTheEndOfItsScipd) {
    expect_nothing_of(ended_by([] { ::raise(SIGKILL); }));
    expect_nothing_of(ended_by([] { ::_exit(3); }));
}

TEST(EndOfATest, IsTheEndOfItsScipdThoughWhatItHasForkedLivesOn) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    expect_nothing_of(ended_by([&] {
        ::close(ends[1]);
        char word = 0;
        if (::fork() == 0) (void)!::read(ends[0], &word, 1);  // until this test is over
        ::_exit(0);
    }));
    ::close(ends[0]);
    ::close(ends[1]);
}

}  // namespace
