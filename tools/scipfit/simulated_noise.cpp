// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/simulated_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/sensor/noise_row.h"

namespace scipd::tools {
namespace {

constexpr std::size_t most_beams = 80;
constexpr std::size_t least_beams = 12;
constexpr std::size_t most_scans = 40;

struct Run {
    std::size_t first = 0;
    std::size_t beams = 0;
};

Run longest_face(const std::vector<Beam>& beams, double beam_rad, bool by_intensity) {
    Run longest;
    Run run;
    for (std::size_t step = 0; step < beams.size(); ++step) {
        if (!tells_noise(beams[step], beam_rad, by_intensity)) {
            run = {step + 1, 0};
            continue;
        }
        ++run.beams;
        if (run.beams > longest.beams) longest = run;
    }
    if (longest.beams <= most_beams) return longest;
    return {longest.first + (longest.beams - most_beams) / 2, most_beams};
}

/// As the scanner would tell it: on its lattice, in whole millimetres.
double told_mm(double mm, const Fit& fit, bool whole_mm) {
    if (fit.lattice.spacing_mm > 0.0)
        mm = fit.lattice.spacing_mm * std::round(mm / fit.lattice.spacing_mm);
    return whole_mm ? std::round(mm) : mm;
}

void simulate(const Station& station, const ScanTable& readings, const Fit& fit, std::size_t first,
              NoisePiece& piece) {
    constexpr double m_per_mm = 1e-3;
    for (std::size_t scan = 0; scan < piece.scans; ++scan) {
        sim::NoiseRow row(piece.beams, 0);
        for (std::size_t beam = 0; beam < piece.beams; ++beam) {
            const Beam& of = station.beams[first + beam];
            const double sigma_mm = fit.noise->model.sigma_mm(of.mean_mm, of.intensity);
            row.set(beam, static_cast<float>(of.mean_mm * m_per_mm),
                    static_cast<float>(sigma_mm * m_per_mm), 0);
        }
        const sim::Smoothing smoothing =
            fit.smoothing ? fit.smoothing->smoothing : sim::Smoothing{};
        row.draw(smoothing, readings.beam_rad(), sim::Chance({.seed = 1, .scan = scan}));
        for (std::size_t beam = 0; beam < piece.beams; ++beam) {
            const double mean_mm = station.beams[first + beam].mean_mm;
            const double noisy_mm = mean_mm + row.noise_m(beam) / m_per_mm;
            piece.simulated_mm.push_back(told_mm(noisy_mm, fit, readings.whole_mm) - mean_mm);
        }
    }
}

}  // namespace

std::optional<NoisePiece> noise_piece(const Standing& standing, const Fit& fit) {
    if (!fit.noise || standing.stations.empty()) return std::nullopt;
    const ScanTable& readings = *standing.readings;
    const Station& station = standing.stations.front();
    const Run face =
        longest_face(station.beams, readings.beam_rad(), fit.noise->model.by_intensity);
    if (face.beams < least_beams) return std::nullopt;
    NoisePiece piece{.first_step = readings.step_of(face.first),
                     .beams = face.beams,
                     .scans = std::min(most_scans, station.scans())};
    for (std::size_t i = 0; i < piece.scans; ++i) {
        for (std::size_t step = face.first; step < face.first + face.beams; ++step) {
            const std::size_t scan = station.first + i;
            const float mm = readings.range_mm(scan, step);
            piece.real_mm.push_back(is_distance(mm)
                                        ? station.residual_mm(mm, scan, station.beams[step])
                                        : std::numeric_limits<double>::quiet_NaN());
        }
    }
    simulate(station, readings, fit, face.first, piece);
    return piece;
}

}  // namespace scipd::tools
