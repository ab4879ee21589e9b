// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/statistics/scan_series.h"

#include <algorithm>
#include <chrono>

namespace scipd::tools {
namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();

Code code_of(const sim::RecordedReading& reading) {
    constexpr std::uint32_t first_high_code = 65533;
    if (reading.kind == sim::RecordedReading::Kind::distance) return codes::distance;
    const bool is_nothing = reading.kind != sim::RecordedReading::Kind::code || reading.code <= 1 ||
                            reading.code >= first_high_code;
    return is_nothing ? codes::nothing : static_cast<Code>(reading.code);
}

/// The stamp after one that is known, where 24 bits have wrapped in between.
double unwrapped_s(double before_s, std::uint32_t stamp_ms) {
    constexpr double wrap_s = (1U << 24) / 1e3;
    const double stamp_s = stamp_ms / 1e3;
    return stamp_s + wrap_s * std::round((before_s - stamp_s) / wrap_s);
}

}  // namespace

std::string name_of_code(Code code) {
    if (code == codes::nothing) return "no distance";
    return code == codes::distance ? "a distance" : std::to_string(code);
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
    const bool bright = !scan.intensities.empty() && (times_.empty() || has_intensities());
    if (!bright) intensities_.clear();
    for (std::size_t beam = 0; beam < beams_; ++beam) {
        const auto ranges = scan.ranges_of(beam);
        const sim::RecordedReading reading =
            ranges.empty() ? sim::RecordedReading{}
                           : sim::reading_of(ranges.front(), scan.unit, identity_);
        const Code code = code_of(reading);
        const bool far = code == codes::distance;
        codes_.push_back(code);
        ranges_mm_.push_back(far ? static_cast<float>(reading.range_m * 1e3) : none);
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
