// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/values/recorded_scan.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace scipd::sim {
namespace {

constexpr double full_turn_rad = 2 * std::numbers::pi;

void append(std::vector<double>& values, std::span<const double> more) {
    values.insert(values.end(), more.begin(), more.end());
}

// SCIP 2.0 has error codes below 20; the USTs say 65533 and more for "nothing".
constexpr double least_mm = 20;
constexpr double first_high_code_mm = 65533;

/// Metres in 32 bits are a little off: 65.533 m by 4 micrometres at most.
bool is_code(double mm) {
    constexpr double rounded_mm = 0.01;
    const bool whole = std::abs(mm - std::round(mm)) < rounded_mm;
    return whole &&
           ((mm > -0.5 && mm < least_mm) || (mm > first_high_code_mm - 0.5 && mm < 1U << 18U));
}

}  // namespace

Directions with_angles(Directions directions, const ScannerIdentity& identity) {
    if (!directions.first_step || !identity.front_step || identity.steps_per_turn.value_or(0) <= 0)
        return directions;
    const double step_rad = full_turn_rad / *identity.steps_per_turn;
    directions.first_rad = (*directions.first_step - *identity.front_step) * step_rad;
    directions.increment_rad = step_rad * directions.cluster;
    return directions;
}

void learn_turn(const Directions& directions, ScannerIdentity& identity) {
    constexpr double most_steps = 1e6;
    if (!directions.first_step || !directions.first_rad || !directions.increment_rad) return;
    const double step_rad = *directions.increment_rad / directions.cluster;
    const double steps = full_turn_rad / step_rad;
    const double from_front = *directions.first_rad / step_rad;
    if (!(steps >= 1 && steps < most_steps && std::abs(from_front) < most_steps)) return;
    identity.steps_per_turn = static_cast<int>(std::lround(steps));
    identity.front_step = *directions.first_step - static_cast<int>(std::lround(from_front));
}

RecordedReading reading_of(double value, RangeUnit unit, const ScannerIdentity& identity) {
    using enum RecordedReading::Kind;
    constexpr double mm_per_m = 1000;
    if (std::isnan(value)) return {nothing};
    if (std::isinf(value)) return {value < 0 ? too_near : too_far};
    const double mm = unit == RangeUnit::metres ? value * mm_per_m : value;
    const double told_mm = identity.min_range_m.value_or(0.0) * mm_per_m;
    const double from_mm = told_mm > 0 ? told_mm : least_mm;
    const double to_mm =
        identity.max_range_m ? *identity.max_range_m * mm_per_m : first_high_code_mm - 1;
    constexpr double rounded_mm = 0.01;
    if (mm >= from_mm - rounded_mm && mm <= to_mm + rounded_mm && mm > 0)
        return {distance, mm / mm_per_m};
    if (unit == RangeUnit::metres && !(mm > 0)) return {nothing};  // drivers write 0 as well
    if (is_code(mm)) return {code, 0, static_cast<std::uint32_t>(std::lround(mm))};
    return {mm < from_mm ? too_near : too_far};
}

RecordedScan counter_clockwise(RecordedScan scan) {
    Directions& directions = scan.directions;
    if (!(directions.increment_rad.value_or(0.0) < 0.0) || scan.steps() == 0) return scan;
    if (directions.first_rad)
        *directions.first_rad += *directions.increment_rad * static_cast<double>(scan.steps() - 1);
    *directions.increment_rad = -*directions.increment_rad;
    std::vector<double> ranges;
    std::vector<double> intensities;
    std::vector<std::uint32_t> ends;
    for (std::size_t step = scan.steps(); step-- > 0;) {
        append(ranges, scan.ranges_of(step));
        append(intensities, scan.intensities_of(step));
        if (scan.has_echoes()) ends.push_back(static_cast<std::uint32_t>(ranges.size()));
    }
    scan.ranges = std::move(ranges);
    scan.intensities = std::move(intensities);
    scan.echo_ends = std::move(ends);
    return scan;
}

}  // namespace scipd::sim
