// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

namespace scipd::tools {

/// The value at this share of the sorted values, from the least to the greatest; 0 of none.
inline double at_share(const std::vector<double>& sorted, double share) {
    if (sorted.empty()) return 0.0;
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

/// The median of many measurements, and the range that holds eight of ten.
struct Spread {
    double median = 0.0;
    double low = 0.0;
    double high = 0.0;
};

inline Spread spread_of(std::vector<double> values) {
    std::ranges::sort(values);
    return {at_share(values, 0.5), at_share(values, 0.1), at_share(values, 0.9)};
}

/// The value with this many significant digits, without an exponent.
inline std::string significant(double value, int digits) {
    const int before = value > 0.0 ? static_cast<int>(std::floor(std::log10(value))) + 1 : digits;
    std::ostringstream text;
    text << std::fixed << std::setprecision(std::max(0, digits - before)) << value;
    return text.str();
}

template <typename Work>
double milliseconds_for(Work work) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    work();
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

}  // namespace scipd::tools
