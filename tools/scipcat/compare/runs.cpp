// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/compare/runs.h"

#include <algorithm>
#include <cmath>

namespace scipd::tools::comparing {
namespace {

std::vector<Run> runs_of_one_sign(const std::vector<int>& signs) {
    constexpr std::size_t bridged = 2;
    std::vector<Run> runs;
    int sign = 0;
    for (std::size_t i = 0; i < signs.size(); ++i) {
        if (signs[i] == 0) continue;
        const bool goes_on =
            !runs.empty() && signs[i] == sign && i - runs.back().last <= bridged + 1;
        if (goes_on) {
            runs.back().last = i;
        } else {
            runs.push_back({i, i});
        }
        sign = signs[i];
    }
    return runs;
}

/// The mean of values that are known unequally well.
struct Weighted {
    double weights = 0;
    double sum = 0;

    void add(double value, double deviation) {
        if (std::isnan(value) || !(deviation > 0)) return;
        const double weight = 1 / (deviation * deviation);
        weights += weight;
        sum += weight * value;
    }
    [[nodiscard]] double mean() const { return sum / weights; }
    [[nodiscard]] double variance() const { return 1 / weights; }
};

Weighted without(const Weighted& all, const Weighted& part) {
    return {all.weights - part.weights, all.sum - part.sum};
}

bool are_two(const Weighted& left, const Weighted& right) {
    constexpr double surely = 6;
    const double apart = std::abs(left.mean() - right.mean());
    return apart > surely * std::sqrt(left.variance() + right.variance()) &&
           apart > 0.5 * std::max(std::abs(left.mean()), std::abs(right.mean()));
}

void take_apart(const Run& run, const Effects& effects, std::vector<Run>& parts) {
    Weighted all;
    for (std::size_t i = run.first; i <= run.last; ++i)
        all.add(effects.values[i], effects.deviations[i]);
    Weighted left;
    Weighted best_left;
    std::size_t best = run.last;
    double most = 0;
    for (std::size_t i = run.first; i < run.last; ++i) {
        left.add(effects.values[i], effects.deviations[i]);
        const Weighted right = without(all, left);
        if (!(left.weights > 0) || !(right.weights > 1e-12 * all.weights)) continue;
        const double apart = left.mean() - right.mean();
        const double explained = left.weights * right.weights / all.weights * apart * apart;
        if (explained <= most) continue;
        most = explained;
        best = i;
        best_left = left;
    }
    if (best == run.last || !are_two(best_left, without(all, best_left))) {
        parts.push_back(run);
        return;
    }
    take_apart({run.first, best}, effects, parts);
    take_apart({best + 1, run.last}, effects, parts);
}

}  // namespace

std::vector<Run> runs_of(const std::vector<int>& signs, const Effects& effects) {
    std::vector<Run> runs;
    for (const Run& run : runs_of_one_sign(signs))
        take_apart(run, effects, runs);
    return runs;
}

}  // namespace scipd::tools::comparing
