// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/poses/arrivals.h"

#include <string>
#include <vector>

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

/// All that the log says of poses that come evenly for twelve seconds, this much too late.
std::vector<Arrivals::News> said(std::chrono::milliseconds period, const PoseNeeds& needs,
                                 std::optional<sim::Time> late = 0ms) {
    Arrivals arrivals;
    std::vector<Arrivals::News> all;
    for (auto at = 0ms; at <= 12s; at += period) {
        arrivals.note(begin + at, late);
        if (const auto news = arrivals.news(begin + at, needs)) all.push_back(*news);
    }
    return all;
}

std::string only_text(const std::vector<Arrivals::News>& all, bool warns) {
    EXPECT_EQ(all.size(), 1U);
    if (all.size() != 1) return {};
    EXPECT_EQ(all.front().warns, warns);
    return all.front().text;
}

TEST(Arrivals, LogTheRateOnce) {
    const PoseNeeds needs{.policy = {.after = sim::PosePolicy::After::extrapolate}, .sweep = 25ms};
    EXPECT_EQ(only_text(said(100ms, needs), false), "come 10 times a second, up to 0 ms late");
    EXPECT_EQ(only_text(said(100ms, needs, std::nullopt), false),
              "come 10 times a second, without timestamps");
    EXPECT_EQ(only_text(said(1ms, {.sweep = 25ms}), false),
              "come 1e+03 times a second, up to 0 ms late");
}

TEST(Arrivals, DoNotTakeAPauseForARate) {
    Arrivals arrivals;
    for (const auto first : {0s, 60s}) {
        for (auto at = 0ms; at <= 6s; at += 50ms) {
            arrivals.note(begin + first + at, 0ms);
            const auto news = arrivals.news(begin + first + at, {.wait = 65ms, .sweep = 25ms});
            EXPECT_EQ(news.has_value(), first == 0s && at == 2s);
        }
    }
}

TEST(Arrivals, WarnWhereScansUseOldPoses) {
    EXPECT_EQ(only_text(said(50ms, {.sweep = 25ms}), true),
              "come 20 times a second, up to 0 ms late: scans use poses up to 50 ms old; set "
              "wait_ms: 65, or after: extrapolate");
    EXPECT_EQ(only_text(said(50ms, {.wait = 30ms, .sweep = 25ms}, 20ms), true),
              "come 20 times a second, up to 20 ms late: scans use poses up to 40 ms old; set "
              "wait_ms: 85, or after: extrapolate");
    (void)only_text(said(50ms, {.wait = 65ms, .sweep = 25ms}), false);
}

TEST(Arrivals, WarnWhereTheRobotStandsBetweenPosesOrJumps) {
    const PoseNeeds needs{.policy = {.after = sim::PosePolicy::After::extrapolate}, .sweep = 25ms};
    EXPECT_EQ(only_text(said(400ms, needs, 200ms), true),
              "come 2.5 times a second, up to 200 ms late: the robot stands before each comes; "
              "send more, or set stale_s: 0.7");
    EXPECT_EQ(only_text(said(1500ms, needs), true),
              "come 0.667 times a second, up to 0 ms late: the robot jumps from each to the next; "
              "send more than one a second");
}

}  // namespace
}  // namespace scipd::daemon
