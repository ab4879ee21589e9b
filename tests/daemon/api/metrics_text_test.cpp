// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/metrics_text.h"

#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

// A number that is rounded on its way would be another bucket, or a counter that stands still.
TEST(MetricsText, WritesLargeCountsInFull) {
    SensorReport sensor{.name = "robot/front"};
    sensor.counts.sent_bytes = 123'456'789'012'345;
    const std::string text = metrics_text({.sensors = {sensor}});
    EXPECT_NE(text.find("scipd_sent_bytes_total{sensor=\"robot/front\"} 123456789012345\n"),
              text.npos)
        << text;
}

TEST(MetricsText, TellsWhatEachLimitHasRefused) {
    const std::string text =
        metrics_text({.limited = {{"http_body_bytes", 3}, {"poses_per_s", 0}}});
    EXPECT_NE(text.find("# TYPE scipd_limited_total counter\n"
                        "scipd_limited_total{limit=\"http_body_bytes\"} 3\n"
                        "scipd_limited_total{limit=\"poses_per_s\"} 0\n"),
              text.npos)
        << text;
}

// Every bound holds those below it.
TEST(MetricsText, CountsLatenessUpToEachBound) {
    SensorReport sensor{.name = "robot/front"};
    for (const auto late : {1us, 63us, 65us, 1000us, 1023us, 1025us, 2000000us})
        sensor.counts.lateness.add(late);
    const std::string text = metrics_text({.sensors = {sensor}});
    const auto told = [&](const std::string& sample, const std::string& value) {
        return text.find("\nscipd_lateness_seconds_" + sample + "} " + value + "\n") != text.npos;
    };
    const std::string bucket = "bucket{sensor=\"robot/front\",le=\"";
    EXPECT_TRUE(told(bucket + "6.4e-05\"", "2")) << text;
    EXPECT_TRUE(told(bucket + "0.000128\"", "3")) << text;
    EXPECT_TRUE(told(bucket + "0.001024\"", "5")) << text;
    EXPECT_TRUE(told(bucket + "0.002048\"", "6")) << text;
    EXPECT_TRUE(told(bucket + "1.048576\"", "6")) << text;
    EXPECT_TRUE(told(bucket + "+Inf\"", "7")) << text;
    EXPECT_TRUE(told("count{sensor=\"robot/front\"", "7")) << text;
    EXPECT_TRUE(told("sum{sensor=\"robot/front\"", "2.003177")) << text;
}

TEST(SensorCounts, AddUp) {
    SensorCounts counts{.scans = 1, .lost = 2, .sent_bytes = 10, .faults = 3};
    counts.casts["embree"] = {2, 2s};
    counts.refused["0E"] = 1;
    counts.lateness.add(3us);
    SensorCounts more{.scans = 4, .lost = 1, .sent_bytes = 5, .faults = 1};
    more.casts["embree"] = {1, 1s};
    more.casts["depth"] = {7, 1s};
    more.refused["0E"] = 2;
    more.refused["10"] = 1;
    more.lateness.add(5us);
    counts += more;
    EXPECT_EQ(counts.scans, 5U);
    EXPECT_EQ(counts.lost, 3U);
    EXPECT_EQ(counts.sent_bytes, 15U);
    EXPECT_EQ(counts.faults, 4U);
    EXPECT_EQ(counts.casts["embree"].casts, 3U);
    EXPECT_EQ(counts.casts["embree"].spent, 3s);
    EXPECT_EQ(counts.casts["depth"].casts, 7U);
    EXPECT_EQ(counts.refused, (protocol::StatusCounts{{"0E", 3}, {"10", 1}}));
    EXPECT_EQ(counts.lateness.count(), 2U);
    EXPECT_EQ(counts.lateness.sum(), 8us);
    EXPECT_EQ(counts.lateness.max(), 5us);
}

}  // namespace
}  // namespace scipd::daemon
