// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/held_out.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace scipd::tools {
namespace {

constexpr std::size_t least_beams_learned = 10;

struct Score {
    double covered = 0, law = 0, sheet = 0, constant = 0, per_beam = 0, count = 0;
};

/// The mean negative log-likelihood of `count` readings of a variance around their mean.
double nll(double sigma_mm, double variance_mm2) {
    constexpr double log_root_two_pi = 0.9189385332046727;
    return log_root_two_pi + std::log(sigma_mm) + 0.5 * variance_mm2 / (sigma_mm * sigma_mm);
}

/// One beam in the half of its time that was not fitted.
struct BeamTest {
    std::vector<float> mm;
    LawSample sample;
};

void judge(const BeamTest& test, const NoiseModel& model, double constant_mm, double sheet,
           Score& score) {
    double sum = 0.0;
    for (const float mm : test.mm)
        sum += mm;
    const double n = static_cast<double>(test.mm.size());
    const double sigma_mm = model.told_mm(test.sample);
    double squares = 0.0;
    for (const float mm : test.mm) {
        const double off = mm - sum / n;
        squares += off * off;
        score.covered += std::abs(off) < 1.96 * sigma_mm ? 1.0 : 0.0;
    }
    // A beam that reads the same all the time has a deviation that no density is made of.
    const double own_mm = std::sqrt(std::max(squares / n, 1.0 / 12.0));
    score.law += n * nll(sigma_mm, squares / n);
    score.constant += n * nll(constant_mm, squares / n);
    score.per_beam += n * nll(own_mm, squares / n);
    if (sheet > 0.0) score.sheet += n * nll(sheet, squares / n);
    score.count += n;
}

/// Fits to one half, and judges with the other.
void judge_half(const Standing& standing, const NoiseModel& kind, const sim::SensorSpec& sheet,
                int fitted_half, Score& score) {
    const ScanTable& readings = *standing.readings;
    const auto samples = [&](int which) {
        return samples_of(standing.stations, standing.sums, readings.beam_rad(),
                          Weights::half(standing.sums, which), kind.by_intensity);
    };
    const auto learned = samples(fitted_half);
    if (learned.size() < least_beams_learned) return;
    const NoiseModel model = fit_model(learned, kind);
    NoiseModel plain = kind;
    plain.by_intensity = false;
    plain.steps.clear();
    plain = fit_model(learned, plain);
    const Weights weights = Weights::half(standing.sums, 1 - fitted_half);
    for (std::size_t i = 0; i < standing.stations.size(); ++i) {
        const Station& station = standing.stations[i];
        const StationSums& sums = standing.sums[i];
        for (std::size_t beam = 0; beam < sums.beams; ++beam) {
            const Beam& seen = station.beams[beam];
            if (!tells_noise(seen, readings.beam_rad(), kind.by_intensity)) continue;
            BeamTest test{{}, {seen.mean_mm, seen.intensity, seen.slope_mm, 0.0, 0.0}};
            for (std::size_t scan = station.first; scan < station.end; ++scan) {
                const std::size_t chunk = (scan - station.first) * sums.chunks / station.scans();
                const float mm = readings.range_mm(scan, beam);
                if (weights.of(i, chunk, beam) > 0.0F && is_distance(mm)) test.mm.push_back(mm);
            }
            if (test.mm.size() < 8) continue;
            judge(test, model, plain.told_mm(test.sample), sheet_mm(sheet, seen.mean_mm), score);
        }
    }
}

}  // namespace

double sheet_mm(const sim::SensorSpec& sheet, double range_mm) {
    double bound_mm = 0.0;
    for (const sim::AccuracyStep& step : sheet.accuracy) {
        if (range_mm >= 1000.0 * step.from_range_m)
            bound_mm = 1000.0 * step.bound_m + step.bound_share * range_mm;
    }
    return bound_mm;
}

std::optional<HeldOut> held_out(const Standing& standing, const NoiseFit& fit,
                                const sim::SensorSpec& sheet) {
    Score score;
    for (const int half : {0, 1})
        judge_half(standing, fit.model, sheet, half, score);
    if (score.count == 0.0) return std::nullopt;
    return HeldOut{score.covered / score.count,  score.law / score.count,
                   score.sheet / score.count,    score.constant / score.count,
                   score.per_beam / score.count, static_cast<std::size_t>(score.count)};
}

}  // namespace scipd::tools
