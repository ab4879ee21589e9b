// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/statistics/scan_series.h"

#include <algorithm>
#include <chrono>

namespace scipd::tools {
namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();
// SCIP 2.0 has error codes below 20; the USTs say 65533 and more for "nothing".
constexpr double least_mm = 20;
constexpr double first_high_code_mm = 65533;

/// The stamp after one that is known, where 24 bits have wrapped in between.
double unwrapped_s(double before_s, std::uint32_t stamp_ms) {
    constexpr double wrap_s = (1U << 24) / 1e3;
    const double stamp_s = stamp_ms / 1e3;
    return stamp_s + wrap_s * std::round((before_s - stamp_s) / wrap_s);
}

}  // namespace

std::string name_of_code(Code code) {
    switch (code) {
        case codes::no_echo:
            return "no echo";
        case codes::nan:
            return "nan";
        case codes::infinite:
            return "inf";
        case codes::minus_infinite:
            return "-inf";
        case codes::too_far:
            return "too far";
        case codes::distance:
            return "a distance";
        default:
            return std::to_string(code);
    }
}

Code ScanSeries::code_of(double range_mm) const {
    if (std::isnan(range_mm)) return codes::nan;
    if (std::isinf(range_mm)) return range_mm > 0 ? codes::infinite : codes::minus_infinite;
    const double from_mm = identity_.min_range_m ? *identity_.min_range_m * 1e3 : least_mm;
    const double to_mm =
        identity_.max_range_m ? *identity_.max_range_m * 1e3 : first_high_code_mm - 1;
    if (range_mm >= from_mm && range_mm <= to_mm) return codes::distance;
    // Codes in metres of 32 bits are a little off.
    if (range_mm > to_mm && range_mm < first_high_code_mm - 0.5) return codes::too_far;
    return static_cast<Code>(std::lround(std::clamp(range_mm, 0.0, 2e9)));
}

bool ScanSeries::is_double(const sim::RecordedScan& scan) const {
    if (times_.empty()) return false;
    const bool stamped = scan.stamp_ms || scan.stamp_us;
    if (stamped) return scan.stamp_ms == last_.stamp_ms && scan.stamp_us == last_.stamp_us;
    const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    // Two scans of a real scanner are never equal, unless it sees nothing at all.
    return std::ranges::equal(scan.ranges, last_.ranges, same) &&
           std::ranges::equal(scan.intensities, last_.intensities, same);
}

void ScanSeries::add(const sim::RecordedScan& scan) {
    if (is_double(scan)) {
        ++doubles_;
        return;
    }
    if (times_.empty()) {
        directions_ = scan.directions;
        beams_ = scan.steps();
    } else if (scan.steps() != beams_ || scan.directions.first_step != directions_.first_step ||
               scan.directions.cluster != directions_.cluster) {
        ++odd_ones_;
        return;
    }
    add_readings(scan);
    add_time(scan);
    last_ = scan;
}

void ScanSeries::add_readings(const sim::RecordedScan& scan) {
    const double mm = scan.unit == sim::RangeUnit::metres ? 1e3 : 1;
    const bool bright = !scan.intensities.empty() && (times_.empty() || has_intensities());
    if (!bright) intensities_.clear();
    for (std::size_t beam = 0; beam < beams_; ++beam) {
        const auto ranges = scan.ranges_of(beam);
        const Code code = ranges.empty() ? codes::no_echo : code_of(ranges.front() * mm);
        const bool far = code == codes::distance;
        codes_.push_back(code);
        ranges_mm_.push_back(far ? static_cast<float>(ranges.front() * mm) : none);
        if (bright)
            intensities_.push_back(far ? static_cast<float>(scan.intensities_of(beam).front())
                                       : none);
    }
}

void ScanSeries::add_time(const sim::RecordedScan& scan) {
    ScanTime time;
    if (scan.stamp_us) {
        time.stamp_s = static_cast<double>(*scan.stamp_us) / 1e6;
        tick_s_ = 1e-6;
    } else if (scan.stamp_ms) {
        const auto before = times_.empty() ? std::nullopt : times_.back().stamp_s;
        time.stamp_s = before ? unwrapped_s(*before, *scan.stamp_ms) : *scan.stamp_ms / 1e3;
    }
    if (scan.host_time) {
        if (!first_host_time_) first_host_time_ = scan.host_time;
        time.host_s = std::chrono::duration<double>(*scan.host_time - *first_host_time_).count();
    }
    times_.push_back(time);
}

}  // namespace scipd::tools
