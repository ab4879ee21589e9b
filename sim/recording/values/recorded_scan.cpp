// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/values/recorded_scan.h"

#include <utility>

namespace scipd::sim {
namespace {

void append(std::vector<double>& values, std::span<const double> more) {
    values.insert(values.end(), more.begin(), more.end());
}

}  // namespace

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
