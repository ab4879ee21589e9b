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
    EXPECT_EQ(throttle.admit(start + 1s), " (999 others before)");
    EXPECT_EQ(throttle.admit(start + 1s), std::nullopt);
    EXPECT_EQ(throttle.admit(start + 2500ms), " (1 others before)");
    EXPECT_EQ(throttle.admit(start + 9s), "");
}

}  // namespace
}  // namespace scipd::daemon
