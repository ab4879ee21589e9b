// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

/// The number of one draw among many that differ in one part of what they depend on.
double by_beam(int i) {
    return Chance({.seed = 1, .sensor = 2, .scan = 3})
        .standard_normal(static_cast<std::uint32_t>(i));
}
double by_scan(int i) {
    return Chance({.seed = 1, .sensor = 2, .scan = static_cast<std::uint64_t>(i)})
        .standard_normal(4);
}
double by_sensor(int i) {
    return Chance({.seed = 1, .sensor = static_cast<std::uint64_t>(i), .scan = 3})
        .standard_normal(4);
}
double by_seed(int i) {
    return Chance({.seed = static_cast<std::uint64_t>(i), .sensor = 2, .scan = 3})
        .standard_normal(4);
}

struct Part {
    const char* name;
    double (*one)(int);
};

/// For GoogleTest, which names tests by what it prints.
void PrintTo(const Part& part, std::ostream* out) {  // NOLINT(readability-identifier-naming)
    *out << part.name;
}

std::vector<double> draw(int draws, double (*one)(int)) {
    std::vector<double> numbers;
    for (int i = 0; i < draws; ++i)
        numbers.push_back(one(i));
    return numbers;
}

double mean_of(const std::vector<double>& numbers) {
    double sum = 0.0;
    for (const double x : numbers)
        sum += x;
    return sum / static_cast<double>(numbers.size());
}

/// Both rows have mean 0 and variance 1.
double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum / static_cast<double>(a.size());
}

double normal_below(double x) {
    return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

class EveryPart : public testing::TestWithParam<Part> {};

constexpr int draws = 100'000;
const double standard_error = 1.0 / std::sqrt(draws);

TEST_P(EveryPart, GivesMeanZeroAndDeviationOne) {
    const std::vector<double> numbers = draw(draws, GetParam().one);
    EXPECT_NEAR(mean_of(numbers), 0.0, 5 * standard_error);
    EXPECT_NEAR(correlation(numbers, numbers), 1.0, 5 * std::sqrt(2.0) * standard_error);
}

// Kolmogorov and Smirnov: the largest distance between the two distributions exceeds 2.2 / sqrt(n)
// once in 8000 times.
TEST_P(EveryPart, FollowsTheNormalDistribution) {
    std::vector<double> numbers = draw(draws, GetParam().one);
    std::ranges::sort(numbers);
    double farthest = 0.0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double share = (static_cast<double>(i) + 0.5) / draws;
        farthest = std::max(farthest, std::abs(share - normal_below(numbers[i])));
    }
    EXPECT_LT(farthest, 2.2 * standard_error);
}

TEST_P(EveryPart, GivesNeighboursThatKnowNothingOfEachOther) {
    const std::vector<double> numbers = draw(draws, GetParam().one);
    for (const int lag : {1, 2, 16, 1081}) {
        std::vector<double> later(numbers.begin() + lag, numbers.end());
        EXPECT_NEAR(correlation(later, numbers), 0.0, 5 * standard_error) << "lag " << lag;
    }
}

TEST_P(EveryPart, NeverRepeats) {
    const std::vector<double> numbers = draw(draws, GetParam().one);
    EXPECT_EQ(std::set<double>(numbers.begin(), numbers.end()).size(), numbers.size());
}

// What even() leaves on both sides of it is the chance of a number as far from zero as the normal
// one. random.cpp tells by how much the table may be off.
TEST(Chance, GivesNormalNumbersThatAreExact) {
    const Chance chance({.seed = 5});
    double worst = 0.0;
    for (std::uint32_t beam = 0; beam < 1'000'000; ++beam) {
        const double number = chance.standard_normal(beam);
        const double even = chance.even(beam);
        ASSERT_EQ(std::signbit(number), std::signbit(even));
        const double farther = std::erfc(std::abs(number) / std::numbers::sqrt2);
        const double density = std::sqrt(2.0 / std::numbers::pi) * std::exp(-0.5 * number * number);
        worst = std::max(worst, std::abs(farther - (1.0 - std::abs(even))) / density);
    }
    EXPECT_LT(worst, 3e-7);
}

TEST(Chance, GivesTheNumbersOfManyBeamsAtOnce) {
    const Chance chance({.seed = 5});
    std::vector<float> numbers(100);
    chance.standard_normals(1000, numbers);
    for (std::uint32_t i = 0; i < 100; ++i)
        EXPECT_EQ(numbers[i], static_cast<float>(chance.standard_normal(1000 + i)));
}

INSTANTIATE_TEST_SUITE_P(Chance, EveryPart,
                         testing::Values(Part{"beam", by_beam}, Part{"scan", by_scan},
                                         Part{"sensor", by_sensor}, Part{"seed", by_seed}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(StandardNormal, IsAFunctionOfKeyAndBeam) {
    const Chance chance({.seed = 42, .sensor = 7, .scan = 1'000'000'007});
    const double first = chance.standard_normal(540);
    EXPECT_NE(chance.standard_normal(541), first);
    EXPECT_EQ(chance.standard_normal(540), first);
    EXPECT_EQ(Chance({.seed = 42, .sensor = 7, .scan = 1'000'000'007}).standard_normal(540), first);
}

TEST(StandardNormal, TellsTheFieldsApart) {
    const std::set<double> numbers{Chance({.seed = 1}).standard_normal(0),
                                   Chance({.sensor = 1}).standard_normal(0),
                                   Chance({.scan = 1}).standard_normal(0),
                                   Chance({}).standard_normal(1), Chance({}).standard_normal(0)};
    EXPECT_EQ(numbers.size(), 5U);
}

TEST(StandardNormal, ReachesTheTails) {
    const std::vector<double> numbers = draw(1'000'000, by_beam);
    const auto beyond = [&](double sigmas) {
        return std::ranges::count_if(numbers, [&](double x) { return std::abs(x) > sigmas; });
    };
    // 2699.8 and 63.3 are expected; five standard errors either side.
    EXPECT_NEAR(static_cast<double>(beyond(3.0)), 2699.8, 5 * std::sqrt(2699.8));
    EXPECT_NEAR(static_cast<double>(beyond(4.0)), 63.3, 5 * std::sqrt(63.3));
    EXPECT_EQ(beyond(9.0), 0);
}

// By Kolmogorov and Smirnov, as above.
TEST(Even, IsEvenBetweenItsEnds) {
    std::vector<double> numbers = draw(draws, [](int i) {
        return Chance({.seed = 1, .scan = static_cast<std::uint64_t>(i)}).even(0);
    });
    std::ranges::sort(numbers);
    EXPECT_GT(numbers.front(), -1.0);
    EXPECT_LT(numbers.back(), 1.0);
    double farthest = 0.0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double share = (static_cast<double>(i) + 0.5) / draws;
        farthest = std::max(farthest, std::abs(share - 0.5 * (numbers[i] + 1.0)));
    }
    EXPECT_LT(farthest, 2.2 * standard_error);
}

}  // namespace
}  // namespace scipd::sim
