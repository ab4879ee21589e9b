// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/edge_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace scipd::tools {
namespace {

constexpr double z_95 = 1.96;

/// Edges of at least this are edges of faces, and at most this: beyond it, pulses stand apart.
constexpr double least_jump_mm = 150.0;
constexpr double most_jump_mm = 1000.0;
constexpr std::size_t widest = 8;  ///< more beams than this are a third thing

Interval mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    double squares = 0.0;
    for (const double value : values) {
        sum += value;
        squares += value * value;
    }
    const double n = static_cast<double>(values.size());
    const double mean = sum / n;
    const double variance = std::max(0.0, squares / n - mean * mean) * n / (n - 1.0);
    const double half = z_95 * std::sqrt(variance / n);
    return {mean, mean - half, mean + half};
}

bool seen_by(const Beam& beam, std::size_t scans) {
    return 2 * beam.count > scans;
}

/// How far off a face is that goes on from `inside`, whose slope is known, at another beam.
double off_face_mm(const std::vector<Beam>& beams, std::size_t inside, std::size_t beam) {
    const double apart = static_cast<double>(beam) - static_cast<double>(inside);
    return beams[beam].mean_mm - beams[inside].mean_mm - apart * beams[inside].slope_mm;
}

/// The beams between two faces that lie on neither.
std::size_t between_faces(const Station& station, std::size_t left, std::size_t right) {
    std::size_t count = 0;
    for (std::size_t beam = left + 1; beam < right; ++beam) {
        if (!seen_by(station.beams[beam], station.scans())) continue;
        const double jump = std::abs(off_face_mm(station.beams, left, right));
        const double room = 0.1 * jump + 10.0;
        if (std::abs(off_face_mm(station.beams, left, beam)) > room &&
            std::abs(off_face_mm(station.beams, right, beam)) > room)
            ++count;
    }
    return count;
}

}  // namespace

std::optional<MixedBeams> mixed_beams(const Standing& standing) {
    constexpr std::size_t least_edges = 8;
    std::vector<double> widths;
    double smallest = most_jump_mm;
    double largest = 0.0;
    for (const Station& station : standing.stations) {
        std::size_t left = station.beams.size();
        for (std::size_t beam = 0; beam < station.beams.size(); ++beam) {
            if (!station.beams[beam].inside) continue;
            // Two beams of each face beside an edge are not inside.
            if (left < beam && beam - left > 1 && beam - left <= widest + 4) {
                const double jump = std::abs(off_face_mm(station.beams, left, beam));
                if (jump > least_jump_mm && jump < most_jump_mm) {
                    widths.push_back(static_cast<double>(between_faces(station, left, beam)));
                    smallest = std::min(smallest, jump);
                    largest = std::max(largest, jump);
                }
            }
            left = beam;
        }
    }
    if (widths.size() < least_edges) return std::nullopt;
    return MixedBeams{mean_of(widths), widths.size(), smallest, largest};
}

std::optional<Drift> relative_drift(const Standing& standing) {
    constexpr std::size_t least_blocks = 5;
    if (standing.stations.empty()) return std::nullopt;
    const Station& station = standing.stations.front();
    const double scans = static_cast<double>(station.scans() - 1);
    // Neighbours share their noise, so a block of them counts as one.
    std::vector<double> drifts;
    for (std::size_t first = 0; first < station.beams.size(); first += beams_of_block) {
        double sum = 0.0;
        double count = 0.0;
        const std::size_t end = std::min(first + beams_of_block, station.beams.size());
        for (std::size_t beam = first; beam < end; ++beam) {
            if (!station.beams[beam].inside) continue;
            sum += station.beams[beam].trend_mm * scans;
            count += 1.0;
        }
        if (count > 0.0) drifts.push_back(sum / count);
    }
    if (drifts.size() < least_blocks) return std::nullopt;
    return Drift{mean_of(drifts), standing.readings->period_s() * scans, station.scans()};
}

}  // namespace scipd::tools
