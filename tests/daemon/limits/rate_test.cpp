// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/limits/rate.h"

#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

const Rate::Time start = Rate::Time{} + 1000s;

int admitted(Rate& rate, int asked, std::size_t most, Rate::Time now) {
    int count = 0;
    for (int i = 0; i < asked; ++i)
        count += rate.admit(most, now) ? 1 : 0;
    return count;
}

TEST(Rate, TakesASecondsWorthAtOnceAndNotOneMore) {
    Rate rate;
    EXPECT_EQ(admitted(rate, 100, 100, start), 100);
    EXPECT_FALSE(rate.admit(100, start));
}

TEST(Rate, TakesAsMuchAsTimeHasGoneBy) {
    Rate rate;
    EXPECT_EQ(admitted(rate, 200, 100, start), 100);
    EXPECT_EQ(admitted(rate, 200, 100, start + 250ms), 25);
    EXPECT_EQ(admitted(rate, 200, 100, start + 1h), 100) << "it does not save up";
}

TEST(Rate, NeverHindersWhoKeepsToIt) {
    Rate rate;
    for (int i = 0; i < 10'000; ++i)
        ASSERT_TRUE(rate.admit(1000, start + i * 1ms)) << i;
}

TEST(Rate, IsRestedAfterASecond) {
    Rate rate;
    EXPECT_TRUE(rate.rested(start));
    (void)rate.admit(1, start);
    EXPECT_FALSE(rate.rested(start + 999ms));
    EXPECT_TRUE(rate.rested(start + 1s));
}

}  // namespace
}  // namespace scipd::daemon
