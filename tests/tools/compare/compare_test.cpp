// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What was changed is named, by its steps and its size; what was not is not.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <numbers>
#include <string>

#include <gmock/gmock.h>

#include "tests/tools/compare/made_scans.h"
#include "tools/scipcat/compare/compare_series.h"
#include "tools/scipcat/compare/comparison_words.h"

namespace scipd::tests {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using tools::comparing::Comparison;
using tools::comparing::Difference;
using tools::comparing::What;

Comparison compare(const MadeScans& a, const MadeScans& b, bool fit = true) {
    auto comparison = tools::comparing::compare(make_scans(a), make_scans(b), fit);
    EXPECT_TRUE(comparison) << comparison.error().why;
    return *comparison;
}

std::vector<std::string> sentences(const Comparison& comparison) {
    std::vector<std::string> sentences;
    for (const Difference& difference : comparison.differ)
        sentences.push_back(tools::comparing::sentence_of(difference));
    return sentences;
}

std::vector<Difference> of_kind(const Comparison& comparison, What what) {
    std::vector<Difference> found;
    std::ranges::copy_if(comparison.differ, std::back_inserter(found),
                         [&](const Difference& one) { return one.what == what; });
    return found;
}

int steps_in(const std::vector<Difference>& differences) {
    int steps = 0;
    for (const Difference& difference : differences)
        steps += difference.to - difference.from + 1;
    return steps;
}

// SCIPCAT_PAIRS: how many to try; those who change the tests try 200.
TEST(Compare, FindsNothingBetweenTwoSeeds) {
    const char* const wanted = std::getenv("SCIPCAT_PAIRS");
    const int pairs = wanted != nullptr ? std::atoi(wanted) : 20;
    int wrong = 0;
    for (int i = 0; i < pairs; ++i) {
        const auto seed = static_cast<std::uint32_t>(2 * i);
        const int scans = std::array{20, 40, 60}[i % 3];
        const Comparison comparison =
            compare({.seed = 1000 + seed, .scans = scans}, {.seed = 1001 + seed, .scans = scans});
        EXPECT_LT(std::abs(comparison.mean_mm), comparison.floor.mean_mm);
        if (comparison.alike()) continue;
        ++wrong;
        for (const std::string& sentence : sentences(comparison))
            std::cout << scans << " scans, pair " << i << ": " << sentence << '\n';
    }
    std::cout << wrong << " of " << pairs << " pairs were called different\n";
    EXPECT_LE(wrong, pairs / 50);
}

// A place that hardly tells where one stands in it, as a piece of a wall.
TEST(Compare, FindsNothingInANarrowView) {
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        const Comparison comparison =
            compare({.seed = seed, .steps = 90}, {.seed = seed + 100, .steps = 90});
        EXPECT_THAT(sentences(comparison), IsEmpty());
    }
}

TEST(Compare, FindsNothingBetweenUnequalNumbersOfScans) {
    EXPECT_THAT(sentences(compare({.seed = 1, .scans = 100}, {.seed = 2, .scans = 12})), IsEmpty());
}

TEST(Compare, NamesTheStepsThatSeeAMovedBox) {
    const MadeScans before{.seed = 1};
    const MadeScans after{.seed = 2, .box_nearer_m = 0.31};
    const auto moved = of_kind(compare(before, after), What::mean);
    ASSERT_FALSE(moved.empty());
    // The room itself says which steps see the face in both.
    const auto biggest = std::ranges::max_element(
        moved, {}, [](const Difference& one) { return one.to - one.from; });
    int first = 2000;
    int last = 0;
    for (int step = 0; step < before.steps; ++step) {
        const double angle_rad = -2.356194490192345 + step * 0.004363323129985824;
        const double nearer_m = made_range_m(before, angle_rad) - made_range_m(after, angle_rad);
        if (std::abs(nearer_m * std::cos(angle_rad) - 0.31) > 1e-6) continue;
        first = std::min(first, step);
        last = std::max(last, step);
    }
    EXPECT_NEAR(biggest->from, first, 3);
    EXPECT_NEAR(biggest->to, last, 8);  // its side begins, which is nearer by nearly as much
    EXPECT_NEAR(biggest->difference(), -360, 10);  // the rays meet the face at 22 to 38 degrees
    EXPECT_THAT(tools::comparing::sentence_of(*biggest), HasSubstr(" nearer by 0.3"));
}

TEST(Compare, NamesAWallMovedBy20Millimetres) {
    const auto moved = of_kind(compare({.seed = 1}, {.seed = 2, .box_nearer_m = 0.02}), What::mean);
    const auto sees = std::ranges::find_if(moved, [](const Difference& one) {
        return one.difference() < -15 && one.difference() > -26 && one.to - one.from > 30;
    });
    ASSERT_NE(sees, moved.end());
    EXPECT_LT(sees->by.low, -19);
    EXPECT_GT(sees->by.high, -25);
    EXPECT_LT(steps_in(moved), 120) << "the box is seen by some 90 steps";
}

TEST(Compare, NamesTheBiasOfAnotherUnit) {
    const Comparison comparison = compare({.seed = 1}, {.seed = 2, .too_far_mm = 8});
    const auto means = of_kind(comparison, What::mean);
    EXPECT_GT(steps_in(means), 900);
    for (const Difference& one : means)
        EXPECT_NEAR(one.difference(), 8.5, 3);
    EXPECT_NEAR(comparison.mean_mm, 8.5, 1);
    EXPECT_GT(comparison.mean_within_mm.low, 7);
    EXPECT_THAT(of_kind(comparison, What::sd), IsEmpty());
}

TEST(Compare, NamesTwiceTheNoise) {
    const Comparison comparison = compare({.seed = 1}, {.seed = 2, .sigma_mm = 10});
    const auto spreads = of_kind(comparison, What::sd);
    EXPECT_GT(steps_in(spreads), 950);
    EXPECT_NEAR(comparison.a.sd_mm, 5, 0.3);
    EXPECT_NEAR(comparison.b.sd_mm, 10, 0.5);
    EXPECT_THAT(of_kind(comparison, What::mean), IsEmpty());
    EXPECT_THAT(sentences(comparison), Contains(HasSubstr(" spread 2 times as much: 10")));
}

TEST(Compare, NamesALittleMoreNoise) {
    EXPECT_THAT(of_kind(compare({.seed = 1}, {.seed = 2, .sigma_mm = 6}), What::sd),
                Not(IsEmpty()));
}

TEST(Compare, NamesACodeForAnother) {
    const Comparison rare =
        compare({.seed = 1, .scans = 100}, {.seed = 2, .scans = 100, .edge_code = 6});
    EXPECT_THAT(sentences(rare), Each(AllOf(HasSubstr("code 6 in "), HasSubstr("code 7 in "))));
    EXPECT_THAT(of_kind(rare, What::codes), Not(IsEmpty()));
    const Comparison many = compare({.seed = 1}, {.seed = 2, .window_code = 8});
    EXPECT_THAT(sentences(many), Contains(HasSubstr("no distance in 0.0 % instead of 100 %, code 8 "
                                                    "in 100 % instead of 0.0 %")));
    EXPECT_EQ(many.b.codes.count(tools::codes::nothing), 0U);
}

// A URG sends 0, a UTM 1, a UST 65533.
TEST(Compare, TakesAllCodesForNoDistanceAsOne) {
    for (const int code : {1, 65533})
        EXPECT_THAT(of_kind(compare({.seed = 1}, {.seed = 2, .window_code = code}), What::codes),
                    IsEmpty())
            << code;
}

TEST(Compare, NamesHowBrightThingsAre) {
    const Comparison comparison = compare({.seed = 1}, {.seed = 2, .bright = 1.1});
    EXPECT_THAT(of_kind(comparison, What::intensity), SizeIs(testing::Ge(1)));
    EXPECT_THAT(sentences(comparison), Contains(HasSubstr(" brighter by 10.")));
}

TEST(Compare, NamesWhatNeighboursShare) {
    const Comparison comparison = compare({.seed = 1}, {.seed = 2, .shared = 0});
    const auto found = of_kind(comparison, What::neighbours);
    ASSERT_THAT(found, SizeIs(1));
    EXPECT_NEAR(found[0].a, 1 / 1.5, 0.03);  // 2 shared / (1 + 2 shared²)
    EXPECT_NEAR(found[0].b, 0, 0.03);
}

TEST(Compare, NamesAClockThatRunsFast) {
    // Narrow scans, since the clock alone is looked at.
    const MadeScans slow{.seed = 1, .scans = 400, .steps = 60};
    MadeScans fast = slow;
    fast.seed = 2;
    fast.ppm = 50;
    const auto found = of_kind(compare(slow, fast), What::clock);
    ASSERT_THAT(found, SizeIs(1));
    EXPECT_NEAR(found[0].difference(), 50, 25);
    EXPECT_THAT(of_kind(compare(fast, fast), What::clock), IsEmpty());
}

TEST(Compare, NamesAClockWhoseStampsKeepStep) {
    const MadeScans slow{.seed = 1, .scans = 2400, .steps = 60, .period_s = 0.025};
    MadeScans fast = slow;
    fast.ppm = 50;
    const auto found = of_kind(compare(slow, fast), What::clock);
    ASSERT_THAT(found, SizeIs(1));
    EXPECT_NEAR(found[0].difference(), 50, 20);
    // In five seconds such a clock gains a quarter of its tick, which nobody can see.
    MadeScans brief = fast;
    brief.scans = 200;
    EXPECT_THAT(of_kind(compare(slow, brief), What::clock), IsEmpty());
}

TEST(Compare, NamesAnotherRate) {
    const auto found = of_kind(compare({.seed = 1}, {.seed = 2, .period_s = 0.1}), What::rate);
    ASSERT_THAT(found, SizeIs(1));
    EXPECT_NEAR(found[0].a, 39.92, 0.05);
    EXPECT_NEAR(found[0].b, 10, 0.01);
}

TEST(Compare, AllowsForAnotherPlace) {
    const MadeScans here{.seed = 1};
    const MadeScans there{.seed = 2, .x_m = 0.06, .y_m = -0.04, .yaw_rad = 0.03};
    const Comparison comparison = compare(here, there);
    ASSERT_TRUE(comparison.motion);
    EXPECT_NEAR(comparison.motion->shift_mm.x, 60, 1);
    EXPECT_NEAR(comparison.motion->shift_mm.y, -40, 1);
    EXPECT_NEAR(comparison.motion->turn_rad, 0.03, 0.0005);
    EXPECT_NEAR(comparison.mean_mm, 0, 0.5);
    EXPECT_THAT(of_kind(comparison, What::mean), IsEmpty());
    EXPECT_GT(steps_in(of_kind(compare(here, there, false), What::mean)), 800);
}

TEST(Compare, FindsWhatMovedFromAnotherPlace) {
    const Comparison comparison =
        compare({.seed = 1}, {.seed = 2, .box_nearer_m = 0.2, .x_m = 0.03, .yaw_rad = 0.01});
    EXPECT_NEAR(comparison.motion->shift_mm.x, 30, 1.5);
    EXPECT_THAT(
        of_kind(comparison, What::mean),
        Contains(AllOf(Field(&Difference::a, testing::Gt(1400)),
                       testing::ResultOf([](const Difference& one) { return one.difference(); },
                                         testing::AllOf(testing::Lt(-180), testing::Gt(-260))))));
}

TEST(Compare, GoesByNumbersWhereAnglesAreNotKnown) {
    const Comparison comparison =
        compare({.seed = 1, .angles = false}, {.seed = 2, .box_nearer_m = 0.1, .angles = false});
    EXPECT_FALSE(comparison.by_angle);
    EXPECT_THAT(of_kind(comparison, What::mean), Not(IsEmpty()));
}

TEST(Compare, SaysWhyTwoCannotBeCompared) {
    using tools::comparing::compare;
    const auto few = compare(make_scans({.scans = 3}), make_scans({}), true);
    ASSERT_FALSE(few);
    EXPECT_EQ(few.error().why,
              "made has 3 scans that differ; at least 4 are needed, and 100 are better");
}

}  // namespace
}  // namespace scipd::tests
