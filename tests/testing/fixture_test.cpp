// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the fixture keeps of a test that fails. The failing tests are in kept_when_failed.cpp.
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/recording/open_recording.h"
#include "tests/support/child.h"
#include "tests/support/temp_dir.h"
#include "tests/testing/room.h"

namespace {

using namespace scipd;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(Fixture, KeepsLogWireAndLastScansOfATestThatFails) {
    const tests::TempDir folder;
    ::setenv("SCIPD_KEEP", folder.path().c_str(), 1);
    const auto done = tests::run({KEPT_WHEN_FAILED, room.string()});
    EXPECT_EQ(done.exit_code, 1) << done.err;
    const auto kept = folder.path() / "KeptWhenFailed.Fails";
    EXPECT_THAT(done.err, HasSubstr(kept.string()));
    EXPECT_THAT(tests::read_file(kept / "scipd.log"), HasSubstr("stopped (SIGTERM)"));
    EXPECT_THAT(tests::read_file(kept / "wire.txt"), HasSubstr("tcp > ME0000108001001: "));
    EXPECT_FALSE(exists(folder.path() / "KeptWhenFailed.Passes"));

    const auto crashed = folder.path() / "KeptWhenFailed.HasACrashThatNobodyNotices";
    EXPECT_THAT(done.out, HasSubstr("scipd was ended by signal 6 while it was needed"));
    EXPECT_THAT(tests::read_file(crashed / "scipd.log"), Not(IsEmpty()));

    auto recording = sim::open_recording(kept / "last_scans.mcap");
    ASSERT_TRUE(recording) << recording.error().why;
    const auto item = (*recording)->next();
    ASSERT_TRUE(item && *item);
    const auto& scan = std::get<sim::RecordedScan>((*item)->what);
    EXPECT_EQ(scan.steps(), 1081U);
    EXPECT_EQ(scan.ranges_of(540).front(), 3000);
}

}  // namespace
