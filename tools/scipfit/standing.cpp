// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/standing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace scipd::tools {
namespace {

constexpr std::size_t block_scans = 10;
constexpr std::size_t least_scans_of_station = 2 * block_scans;
constexpr std::size_t most_stations = 8;

/// The means of all beams over some scans, and how much a distance mostly differs from the one in
/// the scan before.
struct Block {
    std::size_t first = 0;
    std::size_t end = 0;
    std::vector<float> mean_mm;  ///< below 0 where there are too few
    double step_mm = 0.0;
};

double median(std::vector<float>& values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

Block block_of(const ScanTable& readings, std::size_t first, std::size_t end) {
    Block block{first, end, std::vector<float>(readings.beams, -1.0F), 0.0};
    std::vector<float> differences;
    for (std::size_t step = 0; step < readings.beams; ++step) {
        double sum = 0.0;
        std::size_t count = 0;
        for (std::size_t scan = first; scan < end; ++scan) {
            const float mm = readings.range_mm(scan, step);
            if (!is_distance(mm)) continue;
            sum += mm;
            ++count;
            if (scan > first && is_distance(readings.range_mm(scan - 1, step)))
                differences.push_back(std::abs(mm - readings.range_mm(scan - 1, step)));
        }
        if (2 * count > end - first)
            block.mean_mm[step] = static_cast<float>(sum / static_cast<double>(count));
    }
    block.step_mm = median(differences);
    return block;
}

/// How far apart the beams mostly are.
double apart_mm(const Block& a, const Block& b) {
    std::vector<float> differences;
    for (std::size_t step = 0; step < a.mean_mm.size(); ++step) {
        if (a.mean_mm[step] >= 0.0F && b.mean_mm[step] >= 0.0F)
            differences.push_back(std::abs(a.mean_mm[step] - b.mean_mm[step]));
    }
    return median(differences);
}

/// Means of ten scans mostly differ by a third of what single scans differ by, where nothing moves.
bool same_place(const Block& a, const Block& b) {
    constexpr double share = 0.55;
    constexpr double least_mm = 1.5;
    return apart_mm(a, b) < std::max(least_mm, share * std::min(a.step_mm, b.step_mm));
}

std::vector<Station> still_times(const ScanTable& readings, std::size_t begin, std::size_t end) {
    std::vector<Station> stations;
    std::optional<Block> first;
    std::optional<Block> before;
    for (std::size_t at = begin; at < end; at += block_scans) {
        Block block = block_of(readings, at, std::min(at + block_scans, end));
        // What is left over at the end is too short to be compared.
        const bool rest = block.end - block.first < block_scans && before;
        if (rest || (before && same_place(*before, block) && same_place(*first, block))) {
            stations.back().end = block.end;
        } else {
            stations.push_back({.first = block.first, .end = block.end});
            first = block;
        }
        before = std::move(block);
    }
    return stations;
}

/// What the distances of a beam add up to.
struct Sums {
    double n = 0, t = 0, tt = 0, x = 0, xx = 0, tx = 0, x4 = 0;
    double steps2 = 0, steps = 0, light = 0;
    float offset = 0.0F, before = no_number;
};

/// Around the trend. Two of its scans are spent on that.
void take_moments(const Sums& sums, Beam& beam) {
    beam.count = static_cast<std::size_t>(sums.n);
    if (sums.n < 4.0) return;
    const double mean_t = sums.t / sums.n;
    const double variance_t = sums.tt / sums.n - mean_t * mean_t;
    const double mean_x = sums.x / sums.n;
    const double common = sums.tx / sums.n - mean_t * mean_x;
    beam.trend_mm = variance_t > 0.0 ? common / variance_t : 0.0;
    beam.mean_mm = sums.offset + mean_x - beam.trend_mm * mean_t;
    const double square = sums.xx / sums.n - mean_x * mean_x - beam.trend_mm * common;
    beam.variance_mm2 = std::max(0.0, square) * sums.n / (sums.n - 2.0);
    beam.scatter_mm2 = sums.steps > 0.0 ? 0.5 * sums.steps2 / sums.steps : 0.0;
    beam.intensity = sums.light / sums.n;
}

void add(float mm, double t, Sums& sums) {
    if (sums.n == 0.0) sums.offset = mm;
    const double x = mm - sums.offset;
    sums.n += 1.0;
    sums.t += t;
    sums.tt += t * t;
    sums.x += x;
    sums.xx += x * x;
    sums.tx += t * x;
    if (is_distance(sums.before)) {
        const double step = mm - sums.before;
        sums.steps2 += step * step;
        sums.steps += 1.0;
    }
}

/// Passers-by and things that come and go leave a few distances far from all others.
std::vector<double> kurtosis_of(const ScanTable& readings, const Station& station) {
    std::vector<double> fourth(readings.beams, 0.0);
    for (std::size_t scan = station.first; scan < station.end; ++scan) {
        for (std::size_t step = 0; step < readings.beams; ++step) {
            const float mm = readings.range_mm(scan, step);
            const Beam& beam = station.beams[step];
            if (!is_distance(mm) || beam.variance_mm2 == 0.0) continue;
            const double e = station.residual_mm(mm, scan, beam);
            fourth[step] +=
                e * e * e * e /
                (beam.variance_mm2 * beam.variance_mm2 * static_cast<double>(beam.count));
        }
    }
    return fourth;
}

/// A beam whose noise is independent from scan to scan has a variance that is like its scatter.
bool is_still(const Beam& beam, std::size_t scans, double kurtosis) {
    constexpr double most_gaps = 0.1;
    constexpr double most_kurtosis = 6.0;  // real ones have 3.0 to 3.3
    const double n = static_cast<double>(beam.count);
    if (n < (1.0 - most_gaps) * static_cast<double>(scans) || n < 8.0) return false;
    // Recorded walls drift by less than their noise.
    const double drift_mm = std::abs(beam.trend_mm) * static_cast<double>(scans);
    if (drift_mm > 3.0 * std::sqrt(beam.variance_mm2) + 1.0) return false;
    const double most = std::max(1.5, 1.0 + 5.0 / std::sqrt(n));
    return beam.variance_mm2 <= most * beam.scatter_mm2 + 0.1 && kurtosis < most_kurtosis;
}

/// A beam that flickers between two things, or meets somebody who moves, varies more than noise.
void leave_out_wild_beams(std::vector<Beam>& beams) {
    constexpr double most = 36.0;  // six times the deviation: a dark wall has four times as much
    std::vector<float> variances;
    for (const Beam& beam : beams) {
        if (beam.still) variances.push_back(static_cast<float>(beam.variance_mm2));
    }
    const double middle = median(variances);
    for (Beam& beam : beams)
        beam.still = beam.still && beam.variance_mm2 <= most * middle + 1.0;
}

void look_at_beams(const ScanTable& readings, Station& station) {
    std::vector<Sums> sums(readings.beams);
    const double middle = 0.5 * static_cast<double>(station.first + station.end - 1);
    for (std::size_t scan = station.first; scan < station.end; ++scan) {
        for (std::size_t step = 0; step < readings.beams; ++step) {
            const float mm = readings.range_mm(scan, step);
            if (is_distance(mm)) {
                add(mm, static_cast<double>(scan) - middle, sums[step]);
                sums[step].light += std::fmax(readings.intensity(scan, step), 0.0F);
            }
            sums[step].before = mm;
        }
    }
    station.beams.resize(readings.beams);
    for (std::size_t step = 0; step < readings.beams; ++step)
        take_moments(sums[step], station.beams[step]);
    const std::vector<double> kurtosis = kurtosis_of(readings, station);
    for (std::size_t step = 0; step < readings.beams; ++step)
        station.beams[step].still = is_still(station.beams[step], station.scans(), kurtosis[step]);
    leave_out_wild_beams(station.beams);
    find_faces(readings.beam_rad(), station.beams);
}

}  // namespace

std::vector<Station> stations_of(const ScanTable& readings) {
    std::vector<Station> stations;
    for (std::size_t i = 1; i < readings.begins.size(); ++i) {
        for (Station& station : still_times(readings, readings.begins[i - 1], readings.begins[i]))
            stations.push_back(std::move(station));
    }
    const bool one = stations.size() == 1;  // too short to tell, and said to be so
    std::erase_if(stations, [&](const Station& station) {
        return !one && station.scans() < least_scans_of_station;
    });
    std::ranges::stable_sort(stations, std::greater{}, &Station::scans);
    if (stations.size() > most_stations) stations.resize(most_stations);
    for (Station& station : stations)
        look_at_beams(readings, station);
    return stations;
}

std::size_t beams_inside(const std::vector<Station>& stations) {
    std::size_t count = 0;
    for (const Station& station : stations)
        count += static_cast<std::size_t>(std::ranges::count_if(station.beams, &Beam::inside));
    return count;
}

}  // namespace scipd::tools
