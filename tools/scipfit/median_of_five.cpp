// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/median_of_five.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sim/random.h"

namespace scipd::tools {
namespace {

constexpr std::uint32_t window = 5;
constexpr std::uint32_t draws = 20000;
constexpr double step = 0.25;
constexpr std::size_t entries = 49;  // to a slope of 12

using Table = std::array<double, entries>;

double median(std::array<double, window> values) {
    std::ranges::nth_element(values, values.begin() + window / 2);
    return values[window / 2];
}

const sim::Chance& chance() {
    static const sim::Chance chance({.seed = 0x6d656469616e, .purpose = sim::Purpose::unit});
    return chance;
}

/// Medians of so many windows, whose single beams have a deviation of 1.
double deviation_of_median(double slope) {
    double squares = 0.0;
    for (std::uint32_t draw = 0; draw < draws; ++draw) {
        std::array<double, window> beams{};
        for (std::uint32_t i = 0; i < window; ++i)
            beams[i] = chance().standard_normal(window * draw + i) + slope * (i - 2.0);
        const double m = median(beams);
        squares += m * m;
    }
    return std::sqrt(squares / draws);
}

/// By the slope in deviations of the median on a flat wall.
Table on_slopes() {
    const double flat = deviation_of_median(0.0);
    Table table{};
    for (std::size_t i = 0; i < entries; ++i)
        table[i] = deviation_of_median(flat * step * static_cast<double>(i)) / flat;
    return table;
}

std::array<double, window> correlations() {
    std::array<double, window> products{};
    for (std::uint32_t draw = 0; draw < draws; ++draw) {
        std::array<double, 2 * window - 1> row{};
        for (std::uint32_t i = 0; i < row.size(); ++i)
            row[i] = chance().standard_normal(2 * window * draw + i);
        const auto at = [&](std::size_t first) {
            std::array<double, window> beams{};
            std::copy_n(row.begin() + static_cast<std::ptrdiff_t>(first), window, beams.begin());
            return median(beams);
        };
        const double here = at(0);
        for (std::size_t lag = 0; lag < window; ++lag)
            products[lag] += here * at(lag);
    }
    for (std::size_t lag = window; lag-- > 0;)
        products[lag] /= products[0];
    return products;
}

}  // namespace

double median_noise_on_slope(double slope) {
    static const Table table = on_slopes();
    const double place = std::min(std::abs(slope) / step, static_cast<double>(entries - 1) - 1e-9);
    const auto below = static_cast<std::size_t>(place);
    const double part = place - static_cast<double>(below);
    return table[below] + part * (table[below + 1] - table[below]);
}

double median_correlation(int lag) {
    static const std::array<double, window> table = correlations();
    return table[static_cast<std::size_t>(lag)];
}

}  // namespace scipd::tools
