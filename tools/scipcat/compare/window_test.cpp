// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/compare/window_test.h"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/students_t.hpp>

namespace scipd::tools::comparing {
namespace {

/// Windows of this many beams begin at every quarter of it.
std::vector<std::size_t> window_sizes(std::size_t pairs) {
    std::vector<std::size_t> sizes;
    for (std::size_t size = 1; size < pairs; size *= 4)
        sizes.push_back(size);
    sizes.push_back(pairs);
    return sizes;
}

std::size_t stride_of(std::size_t size) {
    return std::max<std::size_t>(1, size / 4);
}

/// A table as running sums over the pairs that are left, so that a window is a difference of two.
class RunningSums {
  public:
    RunningSums(const BlockTable& table, const std::vector<bool>& left)
        : blocks_(table.blocks()), columns_(table.pairs() + 1) {
        sums_.assign(blocks_ * columns_, 0);
        counts_.assign(blocks_ * columns_, 0);
        for (std::size_t block = 0; block < blocks_; ++block) {
            for (std::size_t pair = 0; pair < table.pairs(); ++pair) {
                const std::size_t at = block * columns_ + pair;
                sums_[at + 1] = sums_[at] + (left[pair] ? table.sum(block, pair) : 0);
                counts_[at + 1] = counts_[at] + (left[pair] ? table.count(block, pair) : 0);
            }
        }
    }

    [[nodiscard]] std::size_t blocks() const { return blocks_; }
    [[nodiscard]] double sum(std::size_t block, std::size_t first, std::size_t end) const {
        return sums_[block * columns_ + end] - sums_[block * columns_ + first];
    }
    [[nodiscard]] double count(std::size_t block, std::size_t first, std::size_t end) const {
        return counts_[block * columns_ + end] - counts_[block * columns_ + first];
    }

  private:
    std::size_t blocks_;
    std::size_t columns_;
    std::vector<double> sums_;
    std::vector<double> counts_;
};

struct Mean {
    double value = 0;
    double variance = 0;  ///< of it, as the blocks vary
    double blocks = 0;
    double readings = 0;
};

Mean mean_in(const RunningSums& sums, std::size_t first, std::size_t end) {
    Mean mean;
    double squares = 0;
    for (std::size_t block = 0; block < sums.blocks(); ++block) {
        const double count = sums.count(block, first, end);
        if (count < 0.5) continue;
        const double value = sums.sum(block, first, end) / count;
        mean.value += value;
        squares += value * value;
        mean.readings += count;
        ++mean.blocks;
    }
    if (mean.blocks < 2) return mean;
    mean.value /= mean.blocks;
    mean.variance =
        std::max(0.0, squares / mean.blocks - mean.value * mean.value) / (mean.blocks - 1);
    return mean;
}

/// The variance of the difference of both means, and how many degrees of freedom it rests on.
struct Uncertainty {
    double variance = 0;
    double freedom = 0;
};

Uncertainty of_blocks(const Mean& a, const Mean& b) {
    const double both = a.variance + b.variance;
    return {both, both * both /
                      (a.variance * a.variance / (a.blocks - 1) +
                       b.variance * b.variance / (b.blocks - 1))};
}

/// A reading is rounded, so that its mean varies by no less than this, whatever the blocks say.
void round_off(Mean& mean) {
    constexpr double of_one_reading = 0.05;
    mean.variance = std::max(mean.variance, of_one_reading / mean.readings);
}

/// Where all values are 0 or 1 the variance is known, if the blocks do not say that it is larger:
/// then something lasted. The share is that of both, as it is if they do not differ, by the rule of
/// H. Jeffreys.
Uncertainty of_shares(const Mean& a, const Mean& b) {
    constexpr double many = 1e6;
    constexpr double chance_of_blocks = 2;
    const double readings = a.readings + b.readings;
    const double share = (a.value * a.readings + b.value * b.readings + 0.5) / (readings + 1);
    const double expected = share * (1 - share) * (1 / a.readings + 1 / b.readings);
    const double found = a.variance + b.variance;
    if (found < chance_of_blocks * expected) return {std::max(found, expected), many};
    return of_blocks(a, b);
}

/// 0, or the sign of the difference.
int sign_of_difference(Mean a, Mean b, const WindowTest& test) {
    constexpr double fewest_blocks = 4;
    if (std::min(a.blocks, b.blocks) < fewest_blocks) return 0;
    if (test.quantity == Quantity::deviations) {
        round_off(a);
        round_off(b);
    }
    const Uncertainty uncertainty =
        test.quantity == Quantity::shares ? of_shares(a, b) : of_blocks(a, b);
    const double t = (b.value - a.value) / std::sqrt(uncertainty.variance);
    const boost::math::students_t distribution(uncertainty.freedom);
    const double chance = 2 * boost::math::cdf(boost::math::complement(distribution, std::abs(t)));
    return chance < test.chance ? (t > 0 ? 1 : -1) : 0;
}

bool half_left(const std::vector<bool>& left, std::size_t first, std::size_t end) {
    const auto begin = left.begin() + static_cast<std::ptrdiff_t>(first);
    const auto count = std::count(begin, left.begin() + static_cast<std::ptrdiff_t>(end), true);
    return 2 * static_cast<std::size_t>(count) >= end - first;
}

}  // namespace

std::size_t tests_among(std::size_t pairs) {
    std::size_t tests = 0;
    for (const std::size_t size : window_sizes(pairs))
        tests += (pairs - size) / stride_of(size) + 1;
    return tests;
}

std::vector<int> find_differing(const BlockTable& a, const BlockTable& b,
                                const std::vector<bool>& tested, const WindowTest& test) {
    std::vector<int> found(tested.size(), 0);
    std::vector<bool> left = tested;
    for (const std::size_t size : window_sizes(tested.size())) {
        const RunningSums of_a(a, left);
        const RunningSums of_b(b, left);
        for (std::size_t first = 0; first + size <= tested.size(); first += stride_of(size)) {
            if (!half_left(left, first, first + size)) continue;
            const int sign = sign_of_difference(mean_in(of_a, first, first + size),
                                                mean_in(of_b, first, first + size), test);
            for (std::size_t pair = first; sign != 0 && pair < first + size; ++pair) {
                if (left[pair]) found[pair] = sign;
            }
        }
        for (std::size_t pair = 0; pair < found.size(); ++pair)
            left[pair] = left[pair] && found[pair] == 0;
    }
    return found;
}

}  // namespace scipd::tools::comparing
