// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// For benchmarks that compare two things in one run: each round measures both.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

namespace scipd {

inline double median(std::vector<double> numbers) {
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
    std::ranges::nth_element(numbers, middle);
    return *middle;
}

template <typename Work>
double seconds_for(Work work) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    work();
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace scipd
