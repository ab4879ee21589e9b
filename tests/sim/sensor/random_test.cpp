// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

/// All of one kind: `draws` numbers that differ in one field of the key.
template <typename SetField>
std::vector<double> draw(int draws, SetField set_field) {
    std::vector<double> numbers;
    for (int i = 0; i < draws; ++i) {
        ChanceKey key{.seed = 1, .sensor = 2, .scan = 3, .beam = 4};
        set_field(key, i);
        numbers.push_back(standard_normal(key));
    }
    return numbers;
}

void by_beam(ChanceKey& key, int i) {
    key.beam = static_cast<std::uint32_t>(i);
}
void by_scan(ChanceKey& key, int i) {
    key.scan = static_cast<std::uint64_t>(i);
}
void by_sensor(ChanceKey& key, int i) {
    key.sensor = static_cast<std::uint64_t>(i);
}
void by_seed(ChanceKey& key, int i) {
    key.seed = static_cast<std::uint64_t>(i);
}

double mean_of(const std::vector<double>& numbers) {
    double sum = 0.0;
    for (const double x : numbers)
        sum += x;
    return sum / static_cast<double>(numbers.size());
}

/// Of two rows with mean 0 and variance 1.
double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum / static_cast<double>(a.size());
}

double normal_below(double x) {
    return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

class EveryField : public testing::TestWithParam<void (*)(ChanceKey&, int)> {};

constexpr int draws = 100'000;
const double standard_error = 1.0 / std::sqrt(draws);

TEST_P(EveryField, GivesMeanZeroAndDeviationOne) {
    const std::vector<double> numbers = draw(draws, GetParam());
    EXPECT_NEAR(mean_of(numbers), 0.0, 5 * standard_error);
    EXPECT_NEAR(correlation(numbers, numbers), 1.0, 5 * std::sqrt(2.0) * standard_error);
}

// Kolmogorov and Smirnov: the largest distance between the two distributions exceeds 2.2 / sqrt(n)
// once in 8000 times.
TEST_P(EveryField, FollowsTheNormalDistribution) {
    std::vector<double> numbers = draw(draws, GetParam());
    std::ranges::sort(numbers);
    double farthest = 0.0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double share = (static_cast<double>(i) + 0.5) / draws;
        farthest = std::max(farthest, std::abs(share - normal_below(numbers[i])));
    }
    EXPECT_LT(farthest, 2.2 * standard_error);
}

TEST_P(EveryField, GivesNeighboursThatKnowNothingOfEachOther) {
    const std::vector<double> numbers = draw(draws, GetParam());
    for (const int lag : {1, 2, 16, 1081}) {
        std::vector<double> later(numbers.begin() + lag, numbers.end());
        EXPECT_NEAR(correlation(later, numbers), 0.0, 5 * standard_error) << "lag " << lag;
    }
}

TEST_P(EveryField, NeverRepeats) {
    const std::vector<double> numbers = draw(draws, GetParam());
    EXPECT_EQ(std::set<double>(numbers.begin(), numbers.end()).size(), numbers.size());
}

INSTANTIATE_TEST_SUITE_P(Key, EveryField, testing::Values(by_beam, by_scan, by_sensor, by_seed));

TEST(StandardNormal, IsAFunctionOfItsKey) {
    const ChanceKey key{.seed = 42, .sensor = 7, .scan = 1'000'000'007, .beam = 540};
    const double first = standard_normal(key);
    standard_normal({.seed = 42, .sensor = 7, .scan = 8, .beam = 1});
    EXPECT_EQ(standard_normal(key), first);
}

TEST(StandardNormal, TellsTheFieldsApart) {
    const std::set<double> numbers{standard_normal({.seed = 1}), standard_normal({.sensor = 1}),
                                   standard_normal({.scan = 1}), standard_normal({.beam = 1}),
                                   standard_normal({})};
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

}  // namespace
}  // namespace scipd::sim
