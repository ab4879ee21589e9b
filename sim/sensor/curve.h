// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A curve over the range, in linear pieces: constant before the first point and behind the last
// one. A value; any thread.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "sim/sensor/noise_law.h"

namespace scipd::sim {

class Curve {
    struct Piece {
        double begin_m;  ///< of the ranges that it is for
        double value;    ///< at from_m
        double from_m;
        double rise;  ///< per metre
    };
    /// Every comparison with NaN is false: no range, an infinite one included, lies beyond it.
    static constexpr Piece end{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0, 0.0};

    template <class Point>
    using Member = double Point::*;

  public:
    /// `points` have an argument that grows (`at`, mostly range_m) and a value. None: it is 0.
    template <class Point>
    Curve(const std::vector<Point>& points, Member<Point> value,
          Member<Point> at = &Point::range_m) {
        constexpr double far_m = std::numeric_limits<double>::infinity();
        pieces_.reserve(points.size() + 2);
        pieces_.push_back({-far_m, points.empty() ? 0.0 : points.front().*value, 0.0, 0.0});
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool last = i + 1 == points.size();
            const double rise = last ? 0.0
                                     : (points[i + 1].*value - points[i].*value) /
                                           (points[i + 1].*at - points[i].*at);
            pieces_.push_back({points[i].*at, points[i].*value, points[i].*at, rise});
        }
        pieces_.push_back(end);
    }

    /// The deviation of noise at a range. None: the curve is 0.
    explicit Curve(const std::vector<NoiseStep>& noise) {
        constexpr double far_m = std::numeric_limits<double>::infinity();
        pieces_.reserve(noise.size() + 2);
        pieces_.push_back({-far_m, 0.0, 0.0, 0.0});
        for (const NoiseStep& step : noise)
            pieces_.push_back({step.from_range_m, step.sigma_m, 0.0, step.sigma_share});
        pieces_.push_back(end);
    }

    /// Remembers where it was asked last: neighbouring beams mostly lie between the same points,
    /// and a search for each of them would take longer than the rest of a reading.
    class Cursor {
      public:
        explicit Cursor(const Curve& curve) : piece_(curve.pieces_.data()) {}

        /// Not finite where the range is not.
        [[nodiscard]] double at(double range_m) {
            while (range_m < piece_->begin_m)
                --piece_;
            while (range_m >= piece_[1].begin_m)
                ++piece_;
            return piece_->value + piece_->rise * (range_m - piece_->from_m);
        }

      private:
        const Piece* piece_;
    };

    [[nodiscard]] double at(double range_m) const { return Cursor(*this).at(range_m); }

  private:
    std::vector<Piece> pieces_;  ///< the last is `end`
};

}  // namespace scipd::sim
