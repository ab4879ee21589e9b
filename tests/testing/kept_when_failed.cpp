// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Tests that fixture_test.cpp has run, and that fail: kept_when_failed WORLD
#include <csignal>

#include <gtest/gtest.h>

#include "testing/scipd_test.h"

namespace {

using scipd::testing::Scipd;
using KeptWhenFailed = scipd::testing::ScipdTest;

scipd::testing::Options in_the_room() {
    return {.world = ::testing::internal::GetArgvs().at(1), .accuracy = "ideal"};
}

TEST_F(KeptWhenFailed, Fails) {
    Scipd& scipd = start(in_the_room());
    EXPECT_EQ(scipd.scan().at(0), 2.5);
}

TEST_F(KeptWhenFailed, Passes) {
    Scipd& scipd = start(in_the_room());
    EXPECT_EQ(scipd.scan().at(0), 3.0);
}

TEST_F(KeptWhenFailed, HasACrashThatNobodyNotices) {
    Scipd& scipd = start(in_the_room());
    const int process = scipd.pid();
    ::kill(process, SIGABRT);
    while (::kill(process, 0) == 0) {
    }
}

}  // namespace
