// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/reply_grid.h"

#include <gtest/gtest.h>

namespace scipd::protocol {
namespace {

using namespace std::chrono_literals;

TEST(ReplyGrid, ARequestWaitsForTheNextTick) {
    EXPECT_EQ(next_tick(0ms, 25ms), 25ms);
    EXPECT_EQ(next_tick(24'999'999ns, 25ms), 25ms);
    EXPECT_EQ(next_tick(25ms, 25ms), 50ms);
}

TEST(ReplyGrid, AScanLeavesAtTheTickItJustReaches) {
    EXPECT_EQ(tick_at_or_after(0ms, 25ms), 0ms);
    EXPECT_EQ(tick_at_or_after(1ns, 25ms), 25ms);
    EXPECT_EQ(tick_at_or_after(25ms, 25ms), 25ms);
    EXPECT_EQ(tick_at_or_after(18'750us, 1ms), 19ms);
}

TEST(ReplyGrid, WithoutATickNothingWaits) {
    EXPECT_EQ(next_tick(7us, 0ms), 7us);
    EXPECT_EQ(tick_at_or_after(7us, 0ms), 7us);
}

TEST(ReplyGrid, IsComputedFromTheCountAndNeverDrifts) {
    EXPECT_EQ(next_tick(1000h, 25ms), 1000h + 25ms);
}

}  // namespace
}  // namespace scipd::protocol
