// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/poses/arrivals.h"

#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

constexpr Arrivals::Moment begin{1000s};

SourceReport told(const Arrivals& arrivals, Arrivals::Moment now) {
    SourceReport report;
    arrivals.tell(now, report);
    return report;
}

TEST(Arrivals, TellNothingOfASourceThatIsSilent) {
    const SourceReport report = told({}, begin);
    EXPECT_EQ(report.messages, 0U);
    EXPECT_EQ(report.rate_hz, 0.0);
    EXPECT_FALSE(report.age_s);
    EXPECT_FALSE(report.late_ms);
}

TEST(Arrivals, TellHowOftenAndHowLate) {
    Arrivals arrivals;
    // For twenty seconds, a message each 20 ms; each fourth is 8 ms late.
    for (int i = 0; i < 1000; ++i)
        arrivals.note(begin + i * 20ms, i % 4 == 0 ? 8ms : 0ms);
    const SourceReport report = told(arrivals, begin + 19990ms);
    EXPECT_EQ(report.messages, 1000U);
    EXPECT_NEAR(report.rate_hz, 50.0, 0.5);
    EXPECT_NEAR(*report.age_s, 0.01, 1e-9);
    EXPECT_NEAR(*report.late_ms, 2.0, 0.05);
    EXPECT_DOUBLE_EQ(*report.most_late_ms, 8.0);
}

TEST(Arrivals, ForgetWhatIsLongAgo) {
    Arrivals arrivals;
    arrivals.note(begin, 100ms);
    arrivals.note_refused();
    const SourceReport report = told(arrivals, begin + 60s);
    EXPECT_EQ(report.messages, 1U);
    EXPECT_EQ(report.refused, 1U);
    EXPECT_EQ(report.rate_hz, 0.0);
    EXPECT_DOUBLE_EQ(*report.age_s, 60.0);
    EXPECT_FALSE(report.late_ms);
}

TEST(Arrivals, KnowTheRateOfASourceThatHasJustBegun) {
    Arrivals arrivals;
    for (int i = 0; i < 50; ++i)
        arrivals.note(begin + 700ms + i * 10ms, std::nullopt);
    EXPECT_NEAR(told(arrivals, begin + 1200ms).rate_hz, 100.0, 1.0);
}

}  // namespace
}  // namespace scipd::daemon
