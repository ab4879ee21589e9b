// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/analysis/clock_reading.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/analysis/beam_statistics.h"

namespace scipd::tools {
namespace {

double took_s(const ClockAnswer& answer) {
    return answer.answered_s - answer.asked_s;
}

double middle_s(const ClockAnswer& answer) {
    return (answer.asked_s + answer.answered_s) / 2;
}

/// Whoever waited longer than usual knows less.
std::vector<ClockAnswer> without_late_ones(std::span<const ClockAnswer> answers) {
    std::vector<double> times_s;
    for (const ClockAnswer& answer : answers)
        times_s.push_back(took_s(answer));
    const double usual_s = median_of(times_s);
    std::vector<ClockAnswer> kept(answers.begin(), answers.end());
    std::erase_if(kept, [&](const ClockAnswer& answer) { return took_s(answer) > 1.5 * usual_s; });
    return kept;
}

}  // namespace

std::optional<ClockReading> clock_reading(std::span<const ClockAnswer> answers) {
    constexpr std::size_t fewest = 4;
    if (answers.size() < fewest) return std::nullopt;
    const auto kept = without_late_ones(answers);
    if (kept.size() < fewest) return std::nullopt;
    const auto count = static_cast<double>(kept.size());
    ClockReading reading{.soonest_s = took_s(*std::ranges::min_element(kept, {}, took_s))};
    for (const ClockAnswer& answer : kept) {
        reading.device_s += answer.device_s / count;
        reading.host_s += middle_s(answer) / count;
        reading.took_s += took_s(answer) / count;
    }
    double squares = 0;
    for (const ClockAnswer& answer : kept)
        squares +=
            std::pow(answer.device_s - reading.device_s - middle_s(answer) + reading.host_s, 2);
    reading.deviation_s = std::sqrt(squares / (count - 1) / count);
    // The clock had ticked half a millisecond ago.
    reading.device_s += 0.5e-3;
    return reading;
}

ClockRate rate_between(const ClockReading& before, const ClockReading& after) {
    constexpr double wrap_s = (1U << 24) / 1e3;
    // Scanners answer on a grid of their own, which the scatter of the answers does not show.
    constexpr double unseen_s = 5e-5;
    const double host_s = after.host_s - before.host_s;
    double device_s = after.device_s - before.device_s;
    device_s += wrap_s * std::round((host_s - device_s) / wrap_s);
    const double by_chance_s = std::hypot(4 * before.deviation_s, 4 * after.deviation_s, unseen_s);
    const double soonest_s = std::min(before.soonest_s, after.soonest_s);
    const double by_waiting_s = (before.took_s - soonest_s + after.took_s - soonest_s) / 2;
    return {1e6 * (device_s / host_s - 1), 1e6 * (by_chance_s + by_waiting_s) / host_s};
}

}  // namespace scipd::tools
