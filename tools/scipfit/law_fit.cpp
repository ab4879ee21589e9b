// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/law_fit.h"

#include <algorithm>
#include <cmath>

#include <ceres/ceres.h>

#include "tools/scipfit/median_of_five.h"

namespace scipd::tools {
namespace {

/// On steeper walls the ranges within a footprint differ so much that they add noise of their own.
constexpr double steepest = 1.2;

double square(double x) {
    return x * x;
}

double law_mm(double s0_mm, double i0, double intensity) {
    return i0 == 0.0 ? s0_mm : s0_mm * std::sqrt(1.0 + square(i0 / intensity));
}

double told(double sigma_mm, double slope_mm, bool median_of_five, double rounding_mm2) {
    const double on_slope =
        median_of_five ? sigma_mm * median_noise_on_slope(slope_mm / sigma_mm) : sigma_mm;
    return std::sqrt(square(on_slope) + rounding_mm2);
}

/// The logarithm of a measured variance is normally distributed, nearly, with a variance of
/// 2 / freedom, and on average this much below that of the true one.
double mean_of_log(double freedom) {
    return -1.0 / freedom - 1.0 / (3.0 * freedom * freedom);
}

struct LawResidual {
    bool operator()(const double* log_s0, const double* log_i0, double* residual) const {
        const double i0 = with_light ? std::exp(*log_i0) : 0.0;
        const double sigma_mm = law_mm(std::exp(*log_s0), i0, sample.intensity);
        const double told_mm =
            told(sigma_mm, sample.slope_mm, model->median_of_five, model->rounding_mm2);
        const double expected = 2.0 * std::log(told_mm) + mean_of_log(sample.freedom);
        *residual = (std::log(sample.variance_mm2) - expected) /
                    std::sqrt(2.0 / sample.freedom + spread * spread);
        return true;
    }

    LawSample sample;
    const NoiseModel* model;
    bool with_light;
    double spread;
};

class Solver {
  public:
    Solver(const std::vector<LawSample>& samples, const NoiseModel& model, bool with_light)
        : samples_(samples), model_(model), with_light_(with_light) {
        std::vector<double> variances;
        double light = 0.0;
        for (const LawSample& sample : samples) {
            variances.push_back(sample.variance_mm2);
            light += std::log(std::max(1.0, sample.intensity));
        }
        std::ranges::nth_element(variances, variances.begin() + variances.size() / 2);
        log_s0_ = 0.5 * std::log(std::max(0.01, variances[variances.size() / 2]));
        log_light_ = light / static_cast<double>(samples.size());
        log_i0_ = log_light_;
        if (model.s0_mm > 0.0) log_s0_ = std::log(model.s0_mm);
        if (with_light && model.i0 > 0.0) log_i0_ = std::log(model.i0);
    }

    /// Beams that are not as the law says count less. The cost that is left.
    double solve(double spread) {
        ceres::Problem problem;
        add_residuals(spread, problem);
        ceres::Solver::Options options;
        options.logging_type = ceres::SILENT;
        options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
        options.max_num_iterations = 50;
        ceres::Solver::Summary summary;
        ceres::Solve(options, &problem, &summary);
        return summary.final_cost;
    }

    /// What the residuals have beyond chance, from the middle half of them.
    [[nodiscard]] double spread() const {
        std::vector<double> off;
        double chance = 0.0;
        for (const LawSample& sample : samples_) {
            double residual = 0.0;
            LawResidual{sample, &model_, with_light_, 0.0}(&log_s0_, &log_i0_, &residual);
            const double scale = std::sqrt(2.0 / sample.freedom);
            off.push_back(std::abs(residual * scale));
            chance += square(scale);
        }
        const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
        std::ranges::nth_element(off, middle);
        constexpr double deviation_of_median = 1.4826;
        const double excess =
            square(deviation_of_median * *middle) - chance / static_cast<double>(samples_.size());
        return excess > 0.0 ? std::sqrt(excess) : 0.0;
    }

    [[nodiscard]] Jacobian jacobian(double spread) {
        ceres::Problem problem;
        add_residuals(spread, problem);
        ceres::CRSMatrix sparse;
        problem.Evaluate({}, nullptr, nullptr, nullptr, &sparse);
        Jacobian dense{.columns = with_light_ ? 2U : 1U, .values = {}};
        for (int row = 0; row < sparse.num_rows; ++row) {
            for (std::size_t column = 0; column < dense.columns; ++column)
                dense.values.push_back(
                    sparse.values[static_cast<std::size_t>(sparse.rows[row]) + column]);
        }
        return dense;
    }

    [[nodiscard]] double s0_mm() const { return std::exp(log_s0_); }
    [[nodiscard]] double i0() const { return with_light_ ? std::exp(log_i0_) : 0.0; }

  private:
    void add_residuals(double spread, ceres::Problem& problem) {
        constexpr double outlier = 3.0;
        using Cost = ceres::NumericDiffCostFunction<LawResidual, ceres::CENTRAL, 1, 1, 1>;
        auto* const loss = new ceres::HuberLoss(outlier);
        for (const LawSample& sample : samples_) {
            auto* const residual = new LawResidual{sample, &model_, with_light_, spread};
            problem.AddResidualBlock(new Cost(residual), loss, &log_s0_, &log_i0_);
        }
        if (!with_light_) return problem.SetParameterBlockConstant(&log_i0_);
        // Farther off it makes no difference, and in the end no number.
        constexpr double far = 5.0;
        problem.SetParameterLowerBound(&log_i0_, 0, log_light_ - far);
        problem.SetParameterUpperBound(&log_i0_, 0, log_light_ + far);
    }

    const std::vector<LawSample>& samples_;
    const NoiseModel& model_;
    bool with_light_;
    double log_s0_ = 0.0;
    double log_i0_ = 0.0;
    double log_light_ = 0.0;  ///< of the samples, on average
};

}  // namespace

double NoiseModel::sigma_mm(double range_mm, double intensity) const {
    if (by_intensity) return law_mm(s0_mm, i0, std::max(1.0, intensity));
    double sigma = s0_mm;
    for (const NoiseAt& step : steps) {
        if (range_mm >= step.from_mm) sigma = step.sigma_mm;
    }
    return sigma;
}

double NoiseModel::told_mm(const LawSample& sample) const {
    return told(sigma_mm(sample.range_mm, sample.intensity), sample.slope_mm, median_of_five,
                rounding_mm2);
}

bool tells_noise(const Beam& beam, double beam_rad, bool by_intensity) {
    if (by_intensity && !(beam.intensity > 0.0)) return false;
    return beam.inside && std::abs(beam.slope_mm) < steepest * beam.mean_mm * beam_rad;
}

std::vector<LawSample> samples_of(const std::vector<Station>& stations,
                                  const std::vector<StationSums>& sums, double beam_rad,
                                  const Weights& weights, bool by_intensity) {
    constexpr double least_freedom = 8.0;
    std::vector<LawSample> samples;
    for (std::size_t i = 0; i < stations.size(); ++i) {
        for (std::size_t beam = 0; beam < sums[i].beams; ++beam) {
            const Beam& seen = stations[i].beams[beam];
            if (!tells_noise(seen, beam_rad, by_intensity)) continue;
            double count = 0.0;
            double squares = 0.0;
            for (std::size_t chunk = 0; chunk < sums[i].chunks; ++chunk) {
                const double weight = weights.of(i, chunk, beam);
                count += weight * sums[i].count[sums[i].at(chunk, beam)];
                squares += weight * sums[i].squares[sums[i].at(chunk, beam)];
            }
            if (count < least_freedom || squares <= 0.0) continue;
            // The trend has taken two degrees of freedom from all of the beam's residuals.
            const double all = static_cast<double>(seen.count);
            const double freedom = count * (all - 2.0) / all;
            samples.push_back(
                {seen.mean_mm, seen.intensity, seen.slope_mm, squares / freedom, freedom});
        }
    }
    return samples;
}

LawFit fit_law(const std::vector<LawSample>& samples, const NoiseModel& start, bool with_light) {
    if (samples.empty()) return {};
    Solver solver(samples, start, with_light);
    const double cost = solver.solve(0.0);
    const double spread = solver.spread();
    solver.solve(spread);
    // Half of the beams have more noise than the middle one: what is told is their mean variance.
    return {solver.s0_mm() * std::exp(0.25 * spread * spread), solver.i0(), spread,
            solver.jacobian(spread), cost};
}

}  // namespace scipd::tools
