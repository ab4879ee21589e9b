// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/limits/throttle.h"

#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

TEST(Throttle, AdmitsTheFirstAndThenOneASecondWithTheNumberOfOthers) {
    Throttle throttle;
    const Throttle::Time start{1h};
    EXPECT_EQ(throttle.admit(start), "");
    for (auto time = 1ms; time < 1s; time += 1ms)
        EXPECT_EQ(throttle.admit(start + time), std::nullopt);
    EXPECT_EQ(throttle.admit(start + 1s), " (999 similar messages suppressed)");
    EXPECT_EQ(throttle.admit(start + 1s), std::nullopt);
    EXPECT_EQ(throttle.admit(start + 2500ms), " (1 similar message suppressed)");
    EXPECT_EQ(throttle.admit(start + 9s), "");
}

TEST(Throttle, AdmitsAsManyASecondAsItIsToldAndCountsTheRestOnce) {
    Throttle throttle{3};
    const Throttle::Time start{1h};
    for (const auto time : {0ms, 1ms, 999ms})
        EXPECT_EQ(throttle.admit(start + time), "");
    EXPECT_EQ(throttle.admit(start + 999ms), std::nullopt);
    EXPECT_EQ(throttle.take_suppressed(), "1 similar message suppressed");
    EXPECT_EQ(throttle.take_suppressed(), "");
    for (const auto time : {1000ms, 1001ms, 1999ms})
        EXPECT_EQ(throttle.admit(start + time), "");
}

}  // namespace
}  // namespace scipd::daemon
