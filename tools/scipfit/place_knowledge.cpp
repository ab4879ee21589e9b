// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/place_knowledge.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/random.h"
#include "tools/scipfit/place_equations.h"
#include "tools/scipfit/rank.h"

namespace scipd::tools {
namespace {

/// Weighs blocks of neighbouring beams anew: a wall is uneven, and the noise of neighbours alike.
class Replicates {
  public:
    Replicates(const std::vector<Sight>& sights, const PlaceFit& fit)
        : fit_(fit), rows_(rows_of(sights, fit, fit.spread_mm)), places_(rows_of_places(fit)) {
        std::map<std::size_t, std::size_t> numbers;
        for (PlaceRow& row : rows_)
            row.block = numbers.try_emplace(row.block, numbers.size()).first->second;
        blocks_ = numbers.size();
    }

    /// Each block counts by chance, as in a bootstrap of Bayes's kind (Rubin, The Annals of
    /// Statistics 9, 1981): a face of few beams counts little in some, but is missing in none.
    [[nodiscard]] PlaceFit draw(std::uint64_t seed) const {
        const sim::Chance chance = chance_of(seed);
        std::vector<double> times;
        for (std::uint32_t block = 0; block < blocks_; ++block)
            times.push_back(-std::log(0.5 * (1.0 + chance.even(block))));
        PlaceEquations normal(fit_);
        for (const PlaceRow& row : rows_)
            normal.add(row, times[row.block], row.off);
        // Where somebody measured a place, somebody else would measure another.
        auto at = static_cast<std::uint32_t>(blocks_);
        for (const PlaceRow& row : places_)
            normal.add(row, 1.0, row.off + chance.standard_normal(at++) / std::sqrt(row.weight));
        return normal.solved(fit_);
    }

    /// The noise of the readings comes anew: a part of the curve that a few blocks see differs by
    /// that, too, however alike those blocks are.
    [[nodiscard]] PlaceFit draw_noise(std::uint64_t seed) const {
        constexpr double shared = 2.5;  // neighbours share their noise
        const sim::Chance chance = chance_of(seed);
        PlaceEquations normal(fit_);
        std::uint32_t at = 0;
        for (const std::vector<PlaceRow>* rows : {&rows_, &places_}) {
            const double times = rows == &rows_ ? shared : 1.0;
            for (const PlaceRow& row : *rows)
                normal.add(row, 1.0,
                           row.off + chance.standard_normal(at++) * std::sqrt(times / row.weight));
        }
        return normal.solved(fit_);
    }

  private:
    [[nodiscard]] sim::Chance chance_of(std::uint64_t seed) const {
        return sim::Chance({.seed = seed, .scan = blocks_, .purpose = sim::Purpose::unit});
    }

    const PlaceFit& fit_;
    std::vector<PlaceRow> rows_;
    std::vector<PlaceRow> places_;
    std::size_t blocks_ = 0;
};

/// In units of too large an error. Neighbouring beams see the same wall: as if there were a fifth
/// as many.
Jacobian jacobian_of(const std::vector<Sight>& sights, const PlaceFit& fit) {
    constexpr double alike = 5.0;
    const PlaceColumns columns(fit);
    Jacobian jacobian{.columns = columns.count(), .values = {}};
    const auto add = [&](const PlaceRow& row, double times) {
        const std::size_t begin = jacobian.values.size();
        jacobian.values.resize(begin + jacobian.columns, 0.0);
        for (std::size_t i = 0; i < row.count; ++i)
            jacobian.values[begin + row.column[i]] +=
                row.by[i] * std::sqrt(row.weight / times) * columns.unit(row.column[i]);
    };
    for (const PlaceRow& row : rows_of(sights, fit, fit.spread_mm))
        add(row, alike);
    for (const PlaceRow& row : rows_of_places(fit))
        add(row, 1.0);
    return jacobian;
}

/// By offset, slope and what is left in place of the knots.
Jacobian by_line(const Jacobian& jacobian, const std::vector<double>& knots_mm) {
    constexpr double slope_unit = 0.4;  // 2 mm per m, in units of 5 mm
    const auto n = static_cast<Eigen::Index>(knots_mm.size());
    Eigen::MatrixXd line(n, 2);
    for (Eigen::Index i = 0; i < n; ++i)
        line.row(i) << 1.0, slope_unit * knots_mm[static_cast<std::size_t>(i)] / 1000.0;
    Eigen::MatrixXd basis = line.householderQr().householderQ() * Eigen::MatrixXd::Identity(n, n);
    basis.leftCols(2) = line;
    Jacobian other = jacobian;
    const auto columns = static_cast<Eigen::Index>(jacobian.columns);
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<Rows> rows(other.values.data(),
                          static_cast<Eigen::Index>(other.values.size()) / columns, columns);
    rows.leftCols(n) = (rows.leftCols(n) * basis).eval();
    return other;
}

PlaceKnowledge what_is_known(const std::vector<Sight>& sights, const PlaceFit& fit) {
    const PlaceColumns columns(fit);
    const Jacobian jacobian = jacobian_of(sights, fit);
    const std::vector<bool> known = known_parameters(jacobian);
    PlaceKnowledge result;
    result.knots.assign(known.begin(), known.begin() + std::ssize(fit.knots_mm));
    for (std::size_t i = 0; i < fit.places.size(); ++i) {
        const std::size_t at = columns.of_place(i);
        result.places.push_back(known[at] && known[at + 1] && known[at + 2]);
    }
    if (fit.knots_mm.size() < 2) return result;
    const std::vector<bool> line = known_parameters(by_line(jacobian, fit.knots_mm));
    result.offset = line[0];
    result.scale = line[1];
    return result;
}

/// All that a fit tells, one after the other, by the knots of another.
struct Told {
    Told(const PlaceFit& fit, const std::vector<double>& knots_mm) {
        for (const double knot_mm : knots_mm)
            bias.push_back(value_at(fit.knots_mm, fit.bias_mm, knot_mm));
        const LineThrough line = line_through(knots_mm, bias);
        for (const double left_mm : line.left) {
            bent.push_back(line.at_zero + left_mm);
            left.push_back(left_mm);
        }
        offset.push_back(line.at_zero);
        slope.push_back(line.slope * 1000.0);
        for (const FlatPose& place : fit.places) {
            x.push_back(place.x_mm);
            y.push_back(place.y_mm);
            yaw.push_back(place.yaw_rad);
        }
    }

    using Member = std::vector<double> Told::*;
    std::vector<double> bias, bent, left, offset, slope, x, y, yaw;
};

/// Fits again with knots elsewhere: a curve that bends between its knots comes out otherwise, and
/// so does what hangs on it.
PlaceFit with_other_knots(const std::vector<Sight>& sights, PlaceFit fit) {
    std::vector<double> knots_mm = knots_between(fit.knots_mm);
    std::vector<double> bias_mm;
    for (const double knot_mm : knots_mm)
        bias_mm.push_back(value_at(fit.knots_mm, fit.bias_mm, knot_mm));
    fit.knots_mm = std::move(knots_mm);
    fit.bias_mm = std::move(bias_mm);
    refine(sights, fit);
    return fit;
}

/// Intervals by what is told of blocks that are weighed anew, and with other knots.
class Intervals {
  public:
    Intervals(const std::vector<Sight>& sights, const PlaceFit& fit)
        : told_(fit, fit.knots_mm), other_(with_other_knots(sights, fit), fit.knots_mm) {
        const Replicates drawn(sights, fit);
        for (int i = 0; i < replicates; ++i) {
            drawn_.emplace_back(drawn.draw(static_cast<unsigned>(i)), fit.knots_mm);
            noisy_.emplace_back(drawn.draw_noise(static_cast<unsigned>(i)), fit.knots_mm);
        }
    }

    [[nodiscard]] std::vector<Interval> of(Told::Member member) const {
        constexpr double of_knots = 1.5;  // neither of both has them where the curve bends
        std::vector<Interval> intervals;
        for (std::size_t i = 0; i < (told_.*member).size(); ++i) {
            const double value = (told_.*member)[i];
            const double chance = std::max(half_of(drawn_, member, i), half_of(noisy_, member, i));
            const double half = std::hypot(chance, of_knots * ((other_.*member)[i] - value));
            intervals.push_back({value, value - half, value + half});
        }
        return intervals;
    }

  private:
    static double half_of(const std::vector<Told>& list, Told::Member member, std::size_t i) {
        std::vector<double> values;
        for (const Told& one : list)
            values.push_back((one.*member)[i]);
        return interval_of(0.0, values, false).high;
    }

    Told told_;
    Told other_;
    std::vector<Told> drawn_;
    std::vector<Told> noisy_;
};

/// Each interval holds 95 of 100, but of many one is soon outside.
bool hold_zero(const std::vector<Interval>& intervals) {
    constexpr double of_all = 1.5;
    return std::ranges::all_of(intervals, [](const Interval& one) {
        return std::abs(one.value) <= of_all * 0.5 * (one.high - one.low);
    });
}

/// What is known as long as the faces stay may still vary too much with which of them count.
bool is_narrow(const Interval& interval, double unit) {
    return interval.high - interval.low < 2.0 * 1.96 * unit;
}

void forget_what_varies(PlaceKnowledge& known) {
    constexpr double bias_mm = 5.0;
    constexpr double scale_mm_per_m = 2.0;
    constexpr double angle_rad = 0.005;
    known.offset = known.offset && is_narrow(known.offset_mm, bias_mm);
    known.scale = known.scale && is_narrow(known.scale_mm_per_m, scale_mm_per_m);
    known.but_for_slope = known.offset;
    for (std::size_t i = 0; i < known.knots.size(); ++i) {
        known.knots[i] = known.knots[i] && is_narrow(known.bias_mm[i], bias_mm);
        known.but_for_slope = known.but_for_slope && is_narrow(known.bent_mm[i], bias_mm);
    }
    known.offset = known.offset && (known.scale || known.but_for_slope);
    for (std::size_t i = 0; i < known.places.size(); ++i) {
        const PlaceAt& at = known.at[i];
        known.places[i] = known.places[i] && is_narrow(at.x_mm, bias_mm) &&
                          is_narrow(at.y_mm, bias_mm) && is_narrow(at.yaw_rad, angle_rad);
    }
}

}  // namespace

PlaceKnowledge knowledge_of(const std::vector<Sight>& sights, const PlaceFit& fit) {
    PlaceKnowledge known = what_is_known(sights, fit);
    const Intervals intervals(sights, fit);
    known.bias_mm = intervals.of(&Told::bias);
    known.bent_mm = intervals.of(&Told::bent);
    known.is_line = hold_zero(intervals.of(&Told::left));
    known.offset_mm = intervals.of(&Told::offset)[0];
    known.scale_mm_per_m = intervals.of(&Told::slope)[0];
    const auto x = intervals.of(&Told::x);
    const auto y = intervals.of(&Told::y);
    const auto yaw = intervals.of(&Told::yaw);
    for (std::size_t i = 0; i < fit.places.size(); ++i)
        known.at.push_back({x[i], y[i], yaw[i]});
    forget_what_varies(known);
    return known;
}

}  // namespace scipd::tools
