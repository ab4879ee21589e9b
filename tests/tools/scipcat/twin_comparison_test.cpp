// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is told of a twin, by scans whose difference is known.
#include "tools/scipcat/proxy/twin_comparison.h"

#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scipd::tools {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr int steps = 1081;
constexpr double wall_mm = 3000.0;
constexpr double tolerance_mm = 100.0;
const sim::ScannerIdentity identity{.min_range_m = 0.02, .max_range_m = 30.0};

/// Two scanners before a wall, each with a noise of 30 mm.
class TwinComparisonTest : public testing::Test {
  protected:
    sim::RecordedScan scan() {
        sim::RecordedScan scan;
        scan.host_time = sim::host_time_at(1'700'000'000 + scans_);
        scan.directions.first_step = 0;
        for (int i = 0; i < steps; ++i)
            scan.ranges.push_back(std::round(wall_mm + noise_(random_)));
        return scan;
    }

    /// So many scans, with what `change` makes of each of the scanner's.
    template <class Change>
    std::vector<TwinChange> run(int count, Change change) {
        std::vector<TwinChange> changes;
        for (int i = 0; i < count; ++i) {
            ++scans_;
            sim::RecordedScan mine = scan();
            change(mine);
            for (const TwinChange& one : comparison_.add(mine, scan(), identity))
                changes.push_back(one);
        }
        return changes;
    }

    static void nothing(sim::RecordedScan&) {}

    TwinComparison comparison_{tolerance_mm};
    std::mt19937 random_{1};
    std::normal_distribution<> noise_{0.0, 30.0};
    int scans_ = 0;
};

TEST_F(TwinComparisonTest, TakesNoiseForNoDifference) {
    EXPECT_THAT(run(900, nothing), IsEmpty());
    EXPECT_EQ(comparison_.scans(), 900U);
}

TEST_F(TwinComparisonTest, TellsOnceWhatIsNearerAndSinceWhen) {
    EXPECT_THAT(run(31, nothing), IsEmpty());
    const auto changes = run(200, [](sim::RecordedScan& scan) {
        for (int i = 210; i <= 221; ++i)
            scan.ranges[static_cast<std::size_t>(i)] -= 310.0;
    });
    ASSERT_THAT(changes, SizeIs(1));
    const TwinDifference& found = changes[0].difference;
    EXPECT_TRUE(changes[0].begins);
    EXPECT_EQ(found.from, 210);
    EXPECT_EQ(found.to, 221);
    EXPECT_FALSE(found.codes);
    EXPECT_NEAR(found.by_mm(), -310.0, 20.0);
    // The first scans that differ may be too few of those that are looked at together.
    EXPECT_GE(found.scan, 32U);
    EXPECT_LE(found.scan, 31U + TwinComparison::scans_together);
    EXPECT_EQ(found.time, sim::host_time_at(1'700'000'000 + static_cast<int>(found.scan)));
    EXPECT_THAT(sentence_of(changes[0]), HasSubstr("steps 210-221 nearer by 0.3"));
    EXPECT_THAT(comparison_.differences(), SizeIs(1));

    const auto over = run(50, nothing);
    ASSERT_THAT(over, SizeIs(1));
    EXPECT_FALSE(over[0].begins);
    EXPECT_THAT(sentence_of(over[0]), HasSubstr("steps 210-221 agree with the twin's again"));
    EXPECT_THAT(comparison_.differences(), IsEmpty());
}

TEST_F(TwinComparisonTest, TellsOfCodes) {
    const auto changes = run(20, [](sim::RecordedScan& scan) {
        for (std::size_t i = 700; i < 720; ++i)
            scan.ranges[i] = 65533.0;
    });
    ASSERT_THAT(changes, SizeIs(1));
    EXPECT_TRUE(changes[0].difference.codes);
    EXPECT_EQ(changes[0].difference.scanner, 65533.0);
    EXPECT_THAT(json_of(changes[0]),
                HasSubstr(R"("from":700,"to":719,"what":"codes","a":65533.0)"));
}

TEST_F(TwinComparisonTest, TakesAllCodesForNoDistanceAsOne) {
    std::size_t differences = 0;
    for (const double code : {65533.0, 6.0}) {
        for (std::size_t i = 0; i < 2 * TwinComparison::scans_together; ++i) {
            sim::RecordedScan mine = scan();
            sim::RecordedScan twins = scan();
            for (std::size_t step = 700; step < 720; ++step) {
                mine.ranges[step] = code;
                twins.ranges[step] = step < 710 ? 0.0 : 1.0;
            }
            differences += comparison_.add(mine, twins, identity).size();
        }
        EXPECT_EQ(differences, code == 6.0 ? 1U : 0U);
    }
}

TEST_F(TwinComparisonTest, TellsAnewWhatMoves) {
    const auto at = [](std::size_t first, double by_mm) {
        return [=](sim::RecordedScan& scan) {
            for (std::size_t i = first; i < first + 40; ++i)
                scan.ranges[i] += by_mm;
        };
    };
    EXPECT_THAT(run(18, at(100, 500.0)), SizeIs(1));
    EXPECT_THAT(run(18, at(104, 520.0)), IsEmpty());
    EXPECT_THAT(run(18, at(300, 500.0)), SizeIs(2));
    EXPECT_THAT(run(18, at(300, 900.0)), SizeIs(1));
}

TEST_F(TwinComparisonTest, SaysThatStepsAgreeOnlyWhereTheyDo) {
    const auto by = [](std::size_t first, std::size_t last, double by_mm) {
        return [=](sim::RecordedScan& scan) {
            for (std::size_t i = first; i <= last; ++i)
                scan.ranges[i] += by_mm;
        };
    };
    EXPECT_THAT(run(9, by(100, 199, -500.0)), SizeIs(1));
    const auto changes = run(9, by(150, 299, 500.0));
    ASSERT_THAT(changes, SizeIs(2));
    EXPECT_FALSE(changes[0].begins);
    EXPECT_EQ(changes[0].difference.from, 100);
    EXPECT_EQ(changes[0].difference.to, 149);
    EXPECT_TRUE(changes[1].begins);
    EXPECT_EQ(changes[1].difference.from, 150);
    EXPECT_EQ(changes[1].difference.to, 299);
}

TEST_F(TwinComparisonTest, LeavesOtherStepsAlone) {
    sim::RecordedScan part = scan();
    part.directions.first_step = 100;
    for (int i = 0; i < 30; ++i)
        EXPECT_THAT(comparison_.add(part, scan(), identity), IsEmpty());
    part.directions = {.first_step = 0, .cluster = 2};
    for (int i = 0; i < 30; ++i)
        EXPECT_THAT(comparison_.add(part, scan(), identity), IsEmpty());
}

}  // namespace
}  // namespace scipd::tools
