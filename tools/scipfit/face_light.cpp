// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/face_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "sim/random.h"
#include "tools/scipfit/rank.h"
#include <Eigen/Dense>

namespace scipd::tools {
namespace {

/// Beside Lambert's cosine; head-on there is no difference.
constexpr std::array angles_rad{0.0, 0.35, 0.70, 1.05};
/// Too large an error of a logarithm.
constexpr double unit = 0.05;

/// The logarithms of intensities as a sum: of the surface, the range and the angle.
class LightSum {
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  public:
    explicit LightSum(const Calibration& calibration) : fit_(calibration.fit) {
        for (const Sight& sight : calibration.sights) {
            if (sight.intensity > 0.0) surfaces_.try_emplace(sight.surface, surfaces_.size());
        }
        std::size_t number = 0;
        for (auto& [surface, index] : surfaces_)
            index = number++;
        for (const Sight& sight : calibration.sights) {
            if (sight.intensity > 0.0) add(sight);
        }
        weights_ = Eigen::VectorXd::Ones(std::ssize(logs_));
        reference_ = fit_.knots_mm.size() / 2;
    }

    [[nodiscard]] bool empty() const { return logs_.empty(); }
    [[nodiscard]] double reference_mm() const { return fit_.knots_mm[reference_]; }
    [[nodiscard]] const std::map<std::size_t, std::size_t>& surfaces() const { return surfaces_; }
    [[nodiscard]] std::size_t of_range(std::size_t knot) const { return surfaces_.size() + knot; }
    [[nodiscard]] std::size_t of_angle(std::size_t knot) const {
        return of_range(fit_.knots_mm.size()) + knot - 1;
    }
    [[nodiscard]] std::size_t columns() const { return of_angle(angles_rad.size()); }

    /// Those that are far off count less.
    void solve() {
        constexpr int steps = 8;
        constexpr double outlier = 3.0;
        for (int i = 0; i < steps; ++i) {
            values_ = solved(std::vector(blocks_.size(), 1.0));
            const Eigen::ArrayXd off = (logs() - matrix() * values_).array().abs();
            std::vector<double> sorted(off.data(), off.data() + off.size());
            const auto middle = sorted.begin() + std::ssize(sorted) / 2;
            std::ranges::nth_element(sorted, middle);
            deviation_ = std::max(1e-3, 1.4826 * *middle);
            weights_ = 1.0 / (deviation_ * deviation_ + off.square() / (outlier * outlier));
        }
    }

    /// With each block so many times.
    [[nodiscard]] Eigen::VectorXd solved(const std::vector<double>& times) const {
        const Eigen::Index n = static_cast<Eigen::Index>(columns());
        constexpr double hardly = 1e-6;  // decides only where nothing else does
        Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(n, n) * hardly;
        Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
        std::size_t block = 0;
        for (const auto& [key, rows] : blocks_) {
            const double often = times[block++];
            if (often == 0.0) continue;
            const auto part = matrix()(rows, Eigen::all);
            const Eigen::VectorXd weights = often * weights_(rows);
            normal += part.transpose() * weights.asDiagonal() * part;
            right += part.transpose() * weights.asDiagonal() * logs()(rows);
        }
        // At the reference the range makes nothing of it.
        const auto fixed = static_cast<Eigen::Index>(of_range(reference_));
        normal(fixed, fixed) += 1e12;
        return normal.ldlt().solve(right);
    }

    /// Neighbouring beams see the same wall: as if there were a fifth as many.
    [[nodiscard]] std::vector<bool> known() const {
        constexpr double alike = 5.0;
        const Eigen::VectorXd scale = (weights_ / alike).cwiseSqrt() * unit;
        const Rows scaled = scale.asDiagonal() * matrix();
        Jacobian jacobian{.columns = columns(),
                          .values = {scaled.data(), scaled.data() + scaled.size()}};
        jacobian.values.resize(jacobian.values.size() + columns(), 0.0);
        jacobian.values[logs_.size() * columns() + of_range(reference_)] = 1e6;
        return known_parameters(jacobian);
    }

    [[nodiscard]] std::size_t blocks() const { return blocks_.size(); }
    [[nodiscard]] double value(std::size_t column) const {
        return values_(static_cast<Eigen::Index>(column));
    }

  private:
    void add(const Sight& sight) {
        const FlatPose& place = fit_.places[sight.station];
        const FaceLine& face = fit_.faces[sight.face];
        const double direction = place.yaw_rad + sight.angle_rad;
        const double cosine = std::cos(direction - face.normal_rad);
        std::vector<double> row(columns(), 0.0);
        row[surfaces_.at(sight.surface)] = 1.0;
        const Hats range = hats_at(fit_.knots_mm, face.range_mm(place, direction));
        const Hats angle = hats_at({angles_rad.begin(), angles_rad.end()},
                                   std::acos(std::clamp(cosine, -1.0, 1.0)));
        for (std::size_t i = 0; i < 2; ++i) {
            row[of_range(range.knot[i])] += range.share[i];
            if (angle.knot[i] > 0) row[of_angle(angle.knot[i])] += angle.share[i];
        }
        const auto number = std::ssize(logs_);
        blocks_[(sight.station << 32U) + sight.beam / beams_of_block].push_back(number);
        cells_.insert(cells_.end(), row.begin(), row.end());
        logs_.push_back(std::log(sight.intensity / std::max(cosine, 0.05)));
    }

    [[nodiscard]] Eigen::Map<const Rows> matrix() const {
        return {cells_.data(), std::ssize(logs_), static_cast<Eigen::Index>(columns())};
    }
    [[nodiscard]] Eigen::Map<const Eigen::VectorXd> logs() const {
        return {logs_.data(), std::ssize(logs_)};
    }

    const PlaceFit& fit_;
    std::map<std::size_t, std::size_t> surfaces_;  ///< and their columns
    std::map<std::size_t, std::vector<Eigen::Index>> blocks_;
    std::vector<double> cells_;
    std::vector<double> logs_;
    Eigen::VectorXd weights_;
    Eigen::VectorXd values_;
    double deviation_ = 0.0;
    std::size_t reference_ = 0;
};

/// For each column, what it is when blocks are drawn anew.
std::vector<std::vector<double>> drawn(const LightSum& sum) {
    std::vector<std::vector<double>> values(sum.columns());
    for (int i = 0; i < replicates; ++i) {
        const sim::Chance chance({.seed = static_cast<std::uint64_t>(i),
                                  .scan = sum.blocks(),
                                  .purpose = sim::Purpose::unit});
        std::vector<double> times(sum.blocks(), 0.0);
        for (std::size_t draw = 0; draw < sum.blocks(); ++draw)
            times[drawn_of(sum.blocks(), chance, draw)] += 1.0;
        const Eigen::VectorXd one = sum.solved(times);
        for (std::size_t column = 0; column < values.size(); ++column)
            values[column].push_back(std::exp(one(static_cast<Eigen::Index>(column))));
    }
    return values;
}

std::size_t beams_of(std::size_t surface, const std::vector<Sight>& sights) {
    return static_cast<std::size_t>(std::ranges::count(sights, surface, &Sight::surface));
}

Interval lambert_times(double cosine, const Interval& factor) {
    return {cosine * factor.value, cosine * factor.low, cosine * factor.high};
}

}  // namespace

std::optional<FaceLight> light_of_faces(const Calibration& calibration) {
    if (calibration.fit.knots_mm.empty()) return std::nullopt;
    LightSum sum(calibration);
    if (sum.empty()) return std::nullopt;
    sum.solve();
    const std::vector<bool> known = sum.known();
    const auto replicates_of = drawn(sum);
    const auto interval = [&](std::size_t column) {
        return interval_of(std::exp(sum.value(column)), replicates_of[column], true);
    };
    // A few beams tell a brightness that may be ten times another: that is none.
    constexpr double widest = 3.0;
    const auto told = [&](std::size_t column) -> std::optional<Interval> {
        if (!known[column]) return std::nullopt;
        const Interval found = interval(column);
        return found.high > widest * found.low ? std::nullopt : std::optional(found);
    };
    FaceLight light{.reference_mm = sum.reference_mm()};
    const std::vector<double>& knots_mm = calibration.fit.knots_mm;
    for (std::size_t i = 0; i < knots_mm.size(); ++i) {
        if (known[sum.of_range(i)])
            light.by_range.push_back({knots_mm[i], std::exp(sum.value(sum.of_range(i)))});
    }
    for (const auto& [surface, column] : sum.surfaces())
        light.surfaces.push_back({.surface = surface,
                                  .beams = beams_of(surface, calibration.sights),
                                  .intensity = told(column)});
    for (std::size_t i = 1; i < angles_rad.size(); ++i) {
        const std::size_t column = sum.of_angle(i);
        if (!known[column]) continue;
        light.incidence.push_back(
            {angles_rad[i], lambert_times(std::cos(angles_rad[i]), interval(column))});
    }
    if (light.incidence.size() + 1 < angles_rad.size())
        light.unknown.push_back({"incidence", "walls at one range are met at too few angles",
                                 "walls that are met at several angles at each range"});
    return light;
}

}  // namespace scipd::tools
