// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/scan_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(ScanWatch, FindsALoopThatEndsNoTurn) {
    ScanWatch watch(10s);
    EXPECT_THAT(watch.stuck({{"robot/front", 7, true}}, 100s), IsEmpty());
    EXPECT_THAT(watch.stuck({{"robot/front", 7, true}}, 105s), IsEmpty());
    EXPECT_THAT(watch.stuck({{"robot/front", 7, true}}, 110s), ElementsAre("robot/front"));
    EXPECT_THAT(watch.stuck({{"robot/front", 7, true}}, 500s), ElementsAre("robot/front"));
}

TEST(ScanWatch, LetsALoopBeThatEndsTurnsLate) {
    ScanWatch watch(10s);
    for (int look = 0; look < 20; ++look)
        EXPECT_THAT(watch.stuck({{"robot/front", look, true}}, look * 9s), IsEmpty());
}

TEST(ScanWatch, LetsALoopBeThatHasNothingToDo) {
    ScanWatch watch(10s);
    for (int look = 0; look < 20; ++look)
        EXPECT_THAT(watch.stuck({{"robot/front", 7, false}}, look * 9s), IsEmpty());
}

// The whole thread was stopped, or the machine slept.
TEST(ScanWatch, GivesALoopTimeFromTheFirstLookOn) {
    ScanWatch watch(10s);
    EXPECT_THAT(watch.stuck({{"robot/front", 7, false}}, 0s), IsEmpty());
    EXPECT_THAT(watch.stuck({{"robot/front", 7, true}}, 1000s), IsEmpty());
    EXPECT_THAT(watch.stuck({{"robot/front", 8, false}}, 1001s), IsEmpty());
    EXPECT_THAT(watch.stuck({{"robot/front", 8, true}}, 1011s), IsEmpty());
}

TEST(ScanWatch, TellsOneFromTheOthers) {
    ScanWatch watch(10s);
    (void)watch.stuck({{"a/b", 1, true}, {"a/c", 1, true}, {"a/d", 1, true}}, 0s);
    EXPECT_THAT(watch.stuck({{"a/b", 2, true}, {"a/c", 1, true}, {"a/d", 1, false}}, 10s),
                ElementsAre("a/c"));
}

TEST(ScanWatch, ForgetsALoopThatIsGone) {
    ScanWatch watch(10s);
    (void)watch.stuck({{"robot/front", 0, true}}, 0s);
    (void)watch.stuck({}, 5s);
    EXPECT_THAT(watch.stuck({{"robot/front", 0, true}}, 12s), IsEmpty());
}

}  // namespace
}  // namespace scipd::daemon
