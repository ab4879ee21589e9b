// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/analysis/beam_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace scipd::tools {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double mean_of(const std::vector<double>& values) {
    if (values.empty()) return unknown;
    double sum = 0;
    for (const double value : values)
        sum += value;
    return sum / static_cast<double>(values.size());
}

double sd_of(const std::vector<double>& values, double mean) {
    if (values.size() < 2) return unknown;
    double squares = 0;
    for (const double value : values)
        squares += (value - mean) * (value - mean);
    return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

BeamStatistics statistics_of(const ScanTable& series, ScanSpan scans, std::size_t beam) {
    std::vector<double> ranges_mm;
    std::vector<double> intensities;
    for (std::size_t scan = scans.first; scan < scans.end; ++scan) {
        if (!is_distance(series.range_mm(scan, beam))) continue;
        ranges_mm.push_back(series.range_mm(scan, beam));
        const double intensity = series.intensity(scan, beam);
        if (!std::isnan(intensity)) intensities.push_back(intensity);
    }
    BeamStatistics statistics;
    statistics.distances = ranges_mm.size();
    statistics.share = static_cast<double>(ranges_mm.size()) /
                       static_cast<double>(std::max<std::size_t>(scans.count(), 1));
    statistics.mean_mm = mean_of(ranges_mm);
    statistics.sd_mm = sd_of(ranges_mm, statistics.mean_mm);
    statistics.median_mm = median_of(ranges_mm);
    for (double& range_mm : ranges_mm)
        range_mm = std::abs(range_mm - statistics.median_mm);
    statistics.quiet_sd_mm = 1.483 * median_of(std::move(ranges_mm));
    statistics.intensity = mean_of(intensities);
    statistics.intensity_sd = sd_of(intensities, statistics.intensity);
    return statistics;
}

/// Edges are found without knowing the angles: half a degree between beams is the widest that
/// scanners have.
constexpr double usual_increment_rad = 0.0087;

/// A reading that is so much brighter is of another material.
constexpr double as_bright = 1.3;

bool apart(const BeamStatistics& beam, const BeamStatistics& next) {
    if (beam.share < 0.5 || next.share < 0.5) return beam.share > 0 || next.share > 0;
    const double brighter = std::fmax(beam.intensity, next.intensity);
    if (brighter > as_bright * std::fmin(beam.intensity, next.intensity)) return true;
    return !on_one_surface(beam.median_mm, next.median_mm, usual_increment_rad);
}

/// Each pair counts the same, however much its beams spread.
SharedNoise noise_of_pair(const ScanTable& series, std::span<const BeamStatistics> beams,
                          std::size_t beam, std::size_t next, ScanSpan scans) {
    SharedNoise noise;
    for (std::size_t scan = scans.first; scan < scans.end; ++scan) {
        const double one = (series.range_mm(scan, beam) - beams[beam].mean_mm) / beams[beam].sd_mm;
        const double other =
            (series.range_mm(scan, next) - beams[next].mean_mm) / beams[next].sd_mm;
        if (std::isnan(one) || std::isnan(other)) continue;
        noise += {one * other, one * one, other * other};
    }
    return noise;
}

}  // namespace

std::vector<BeamStatistics> beam_statistics(const ScanTable& series, ScanSpan scans) {
    std::vector<BeamStatistics> beams;
    beams.reserve(series.beams);
    for (std::size_t beam = 0; beam < series.beams; ++beam)
        beams.push_back(statistics_of(series, scans, beam));
    return beams;
}

bool is_steady(const BeamStatistics& beam) {
    constexpr double rounded_mm = 1;
    return beam.share >= 0.9 && beam.sd_mm > 0 && beam.sd_mm <= 2 * beam.quiet_sd_mm + rounded_mm;
}

bool on_one_surface(double range_mm, double next_mm, double increment_rad) {
    constexpr double grazing = 8.0;
    constexpr double noise_mm = 20.0;
    const double nearer_mm = std::min(range_mm, next_mm);
    return std::abs(range_mm - next_mm) < grazing * nearer_mm * increment_rad + noise_mm;
}

std::vector<bool> beside_edges(std::span<const BeamStatistics> beams) {
    std::vector<bool> beside(beams.size(), false);
    for (std::size_t i = 0; i + 1 < beams.size(); ++i) {
        if (!apart(beams[i], beams[i + 1])) continue;
        beside[i] = true;
        beside[i + 1] = true;
    }
    return beside;
}

double mixed_share(const ScanTable& series, std::span<const BeamStatistics> beams, ScanSpan scans) {
    constexpr double least_jump_mm = 200;
    std::size_t distances = 0;
    std::size_t mixed = 0;
    for (const BeamStatistics& beam : beams)
        distances += beam.distances;
    for (std::size_t i = 1; i + 1 < beams.size(); ++i) {
        const auto [near_mm, far_mm] = std::minmax(beams[i - 1].median_mm, beams[i + 1].median_mm);
        const double jump_mm = far_mm - near_mm;
        if (!(jump_mm > least_jump_mm)) continue;
        for (std::size_t scan = scans.first; scan < scans.end; ++scan) {
            const double share = (series.range_mm(scan, i) - near_mm) / jump_mm;
            if (share > 0.1 && share < 0.9) ++mixed;
        }
    }
    return distances == 0 ? 0 : static_cast<double>(mixed) / static_cast<double>(distances);
}

double median_of(std::vector<double> values) {
    if (values.empty()) return unknown;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    if (values.size() % 2 == 1) return *middle;
    return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

SharedNoise& SharedNoise::operator+=(const SharedNoise& other) {
    products += other.products;
    squares += other.squares;
    next_squares += other.next_squares;
    return *this;
}

double SharedNoise::correlation() const {
    const double both = std::sqrt(squares * next_squares);
    return both > 0 ? products / both : std::numeric_limits<double>::quiet_NaN();
}

SharedNoise shared_noise(const ScanTable& series, std::span<const BeamStatistics> beams,
                         const std::vector<bool>& beside_edges, ScanSpan scans, std::size_t apart) {
    SharedNoise noise;
    for (std::size_t i = 0; i + apart < beams.size(); ++i) {
        const std::size_t next = i + apart;
        const bool smooth = !beside_edges[i] && !beside_edges[next];
        if (smooth && is_steady(beams[i]) && is_steady(beams[next]))
            noise += noise_of_pair(series, beams, i, next, scans);
    }
    return noise;
}

CodeShares code_shares(const ScanTable& series, std::span<const std::size_t> beams,
                       ScanSpan scans) {
    CodeShares shares;
    for (std::size_t scan = scans.first; scan < scans.end; ++scan) {
        for (const std::size_t beam : beams) {
            const Code code = class_of(series.code(scan, beam));
            if (code != codes::distance) shares[code] += 1;
        }
    }
    const auto readings = static_cast<double>(scans.count() * beams.size());
    for (auto& [code, share] : shares)
        share /= readings;
    return shares;
}

CodeShares code_shares(const ScanTable& series) {
    std::vector<std::size_t> beams(series.beams);
    std::iota(beams.begin(), beams.end(), 0);
    return code_shares(series, beams, all_scans(series));
}

double quantile_of(std::vector<double> values, double share) {
    if (values.empty()) return unknown;
    const double place = share * static_cast<double>(values.size() - 1);
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::lround(place));
    std::ranges::nth_element(values, at);
    return *at;
}

}  // namespace scipd::tools
