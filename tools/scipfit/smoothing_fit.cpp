// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/smoothing_fit.h"

#include <algorithm>
#include <cmath>

#include <ceres/ceres.h>

#include "tools/scipfit/median_of_five.h"

namespace scipd::tools {
namespace {

/// How much farther the next beam of a flat wall may be, in deviations.
constexpr double flat_slope = 0.5;
constexpr std::size_t least_flat_beams = 30;

using Lags = std::array<double, most_lag>;

struct Correlations {
    Lags beside{};
    double after = 0.0;
};

bool is_flat(const Beam& beam) {
    return std::abs(beam.slope_mm) < flat_slope * std::sqrt(beam.variance_mm2);
}

/// The beams whose neighbours count: those on flat walls, or all where there are too few of them.
std::vector<std::vector<bool>> chosen_beams(const std::vector<Station>& stations) {
    std::vector<std::vector<bool>> flat;
    std::vector<std::vector<bool>> all;
    std::size_t count = 0;
    for (const Station& station : stations) {
        flat.emplace_back();
        all.emplace_back();
        for (const Beam& beam : station.beams) {
            all.back().push_back(beam.inside);
            flat.back().push_back(beam.inside && is_flat(beam));
            count += flat.back().back() ? 1 : 0;
        }
    }
    return count < least_flat_beams ? all : flat;
}

class Estimate {
  public:
    Estimate(const std::vector<Station>& stations, const std::vector<StationSums>& sums,
             double rounding_mm2)
        : stations_(stations),
          sums_(sums),
          rounding_mm2_(rounding_mm2),
          chosen_(chosen_beams(stations)) {}

    [[nodiscard]] Correlations under(const Weights& weights) const {
        Lags products{};
        Lags counts{};
        double squares = 0.0;
        double after = 0.0;
        double all = 0.0;
        double own = 0.0;
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            const StationSums& sums = sums_[i];
            const std::vector<double> inverse = inverse_deviations(i);
            for (std::size_t chunk = 0; chunk < sums.chunks; ++chunk) {
                for (std::size_t beam = 0; beam < sums.beams; ++beam) {
                    const std::size_t at = sums.at(chunk, beam);
                    const double weight = weights.of(i, chunk, beam);
                    if (weight == 0.0 || sums.count[at] == 0.0F) continue;
                    const double square = sums.squares[at] * inverse[beam] * inverse[beam];
                    all += weight * square;
                    after += weight * sums.after[at] * inverse[beam] * inverse[beam];
                    if (!chosen_[i][beam]) continue;
                    squares += weight * square;
                    own += weight * sums.count[at];
                    for (std::size_t lag = 0; lag < most_lag && beam + lag + 1 < sums.beams;
                         ++lag) {
                        products[lag] +=
                            weight * sums.beside[lag][at] * inverse[beam] * inverse[beam + lag + 1];
                        counts[lag] += weight * sums.beside_count[lag][at];
                    }
                }
            }
        }
        Correlations found;
        found.after = all > 0.0 ? after / all : 0.0;
        for (std::size_t lag = 0; lag < most_lag; ++lag) {
            if (counts[lag] > 0.0 && squares > 0.0)
                found.beside[lag] = unrounded_ * products[lag] / counts[lag] * own / squares;
        }
        return found;
    }

    /// Rounding adds noise that neighbours do not share.
    void set_rounding() {
        double share = 0.0;
        double count = 0.0;
        for (std::size_t i = 0; i < stations_.size(); ++i) {
            for (std::size_t beam = 0; beam < chosen_[i].size(); ++beam) {
                const double variance = stations_[i].beams[beam].variance_mm2;
                if (!chosen_[i][beam] || variance <= 2.0 * rounding_mm2_) continue;
                share += variance / (variance - rounding_mm2_);
                count += 1.0;
            }
        }
        unrounded_ = count > 0.0 ? share / count : 1.0;
    }

    /// Those that read the same as the next beam: how many, and how many by chance.
    void count_equals(double next, double place_mm, SmoothingFit& fit) const {
        double equal = 0.0;
        double by_chance = 0.0;
        double count = 0.0;
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            for (std::size_t beam = 0; beam + 1 < sums_[i].beams; ++beam) {
                const Beam& here = stations_[i].beams[beam];
                if (!chosen_[i][beam] || !stations_[i].beams[beam + 1].inside) continue;
                double readings = 0.0;
                for (std::size_t chunk = 0; chunk < sums_[i].chunks; ++chunk) {
                    equal += sums_[i].equal[sums_[i].at(chunk, beam)];
                    readings += sums_[i].count[sums_[i].at(chunk, beam)];
                }
                const double apart = stations_[i].beams[beam + 1].mean_mm - here.mean_mm;
                const double deviation =
                    std::sqrt(2.0 * std::max(1e-3, here.variance_mm2 * (1.0 - next)));
                by_chance += readings * within(apart, 0.5 * place_mm, deviation);
                count += readings;
                ++fit.pairs;
            }
        }
        if (count == 0.0) return;
        fit.equal = equal / count;
        fit.equal_by_chance = by_chance / count;
    }

  private:
    /// The share of a normal distribution that lies within `half` of 0.
    static double within(double mean, double half, double deviation) {
        const double scale = 1.0 / (std::sqrt(2.0) * deviation);
        return 0.5 * (std::erf((half - mean) * scale) - std::erf((-half - mean) * scale));
    }

    [[nodiscard]] std::vector<double> inverse_deviations(std::size_t station) const {
        std::vector<double> inverse;
        for (const Beam& beam : stations_[station].beams)
            inverse.push_back(beam.variance_mm2 > 0.0 ? 1.0 / std::sqrt(beam.variance_mm2) : 0.0);
        return inverse;
    }

    const std::vector<Station>& stations_;
    const std::vector<StationSums>& sums_;
    double rounding_mm2_;
    double unrounded_ = 1.0;
    std::vector<std::vector<bool>> chosen_;
};

/// What is left of the correlations that a mix of neighbours has.
struct MixResidual {
    template <class T>
    bool operator()(const T* next, const T* after, T* residual) const {
        const T& a = *next;
        const T& b = *after;
        const T own = 1.0 + 2.0 * (a * a + b * b);
        const std::array<T, most_lag> model{(2.0 * a + 2.0 * a * b) / own, (2.0 * b + a * a) / own,
                                            2.0 * a * b / own, b * b / own};
        for (std::size_t lag = 0; lag < most_lag; ++lag)
            residual[lag] = (model[lag] - (*beside)[lag].value) / deviation(lag);
        return true;
    }

    [[nodiscard]] double deviation(std::size_t lag) const {
        constexpr double of_model = 0.005;  // no real scanner is such a mix exactly
        return of_model + ((*beside)[lag].high - (*beside)[lag].low) / 4.0;
    }

    const std::array<Interval, most_lag>* beside;
};

sim::Smoothing best_mix(const std::array<Interval, most_lag>& beside) {
    double next = 0.2;
    double after = 0.05;
    ceres::Problem problem;
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<MixResidual, most_lag, 1, 1>(new MixResidual{&beside}),
        nullptr, &next, &after);
    for (double* parameter : {&next, &after}) {
        problem.SetParameterLowerBound(parameter, 0, 0.0);
        problem.SetParameterUpperBound(parameter, 0, 1.0);
    }
    ceres::Solver::Options options;
    options.logging_type = ceres::SILENT;
    options.linear_solver_type = ceres::DENSE_QR;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return {.next = next, .after_next = after};
}

/// Medians choose the same beam for half of the neighbours, which no mix of them does.
bool is_median(const SmoothingFit& fit) {
    constexpr double more = 0.15;
    return fit.equal > fit.equal_by_chance + more && fit.beside[0].value > 0.3;
}

}  // namespace

SmoothingFit fit_smoothing(const std::vector<Station>& stations,
                           const std::vector<StationSums>& sums, double rounding_mm2,
                           double place_mm) {
    Estimate estimate(stations, sums, rounding_mm2);
    estimate.set_rounding();
    const Correlations found = estimate.under(Weights(sums));
    std::array<std::vector<double>, most_lag + 1> drawn;
    for (int i = 0; i < replicates; ++i) {
        const Correlations one = estimate.under(Weights::drawn(sums, static_cast<unsigned>(i)));
        for (std::size_t lag = 0; lag < most_lag; ++lag)
            drawn[lag].push_back(one.beside[lag]);
        drawn[most_lag].push_back(one.after);
    }
    SmoothingFit fit;
    for (std::size_t lag = 0; lag < most_lag; ++lag)
        fit.beside[lag] = interval_of(found.beside[lag], drawn[lag], false);
    // Taking out the mean and the trend of n scans takes two n-ths from what scans share.
    double scans = 0.0;
    for (const Station& station : stations)
        scans += static_cast<double>(station.scans());
    const double taken = 2.0 * static_cast<double>(stations.size()) / std::max(1.0, scans);
    fit.after = interval_of(found.after + taken, drawn[most_lag], false);
    estimate.count_equals(fit.beside[0].value, place_mm, fit);
    fit.smoothing = is_median(fit) ? sim::Smoothing{.median_of_five = true} : best_mix(fit.beside);
    return fit;
}

std::array<double, most_lag> correlations_of(const sim::Smoothing& smoothing) {
    Lags found{};
    for (std::size_t lag = 0; lag < most_lag && smoothing.median_of_five; ++lag)
        found[lag] = median_correlation(static_cast<int>(lag) + 1);
    if (smoothing.median_of_five) return found;
    const double a = smoothing.next;
    const double b = smoothing.after_next;
    const double own = 1.0 + 2.0 * (a * a + b * b);
    return {(2.0 * a + 2.0 * a * b) / own, (2.0 * b + a * a) / own, 2.0 * a * b / own, b * b / own};
}

}  // namespace scipd::tools
