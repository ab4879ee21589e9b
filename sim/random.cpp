// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Why no library does this for each beam. Scans must repeat by their seeds, so what a key gives
// must never change: the generators of Random123 would give other noise altogether. They are no
// faster either: for one number Philox 2x64 takes 1.5 times, and Threefry 2x64 1.6 times what
// absorbed() takes. Boost.Math knows the quantiles of the normal distribution, but takes 12 ns for
// each, as long as a ray. So it is asked for those of a table, once.
#include "sim/random.h"

#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include <boost/math/special_functions/erf.hpp>

namespace scipd::sim {
namespace {

/// A bijection in which every bit of the input changes about half the bits of the output: the
/// finalizer of SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators,
/// 2014).
std::uint64_t mixed(std::uint64_t bits) {
    bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9U;
    bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebU;
    return bits ^ (bits >> 31U);
}

std::uint64_t absorbed(std::uint64_t state, std::uint64_t word) {
    constexpr std::uint64_t golden_gamma = 0x9e3779b97f4a7c15U;  // keeps zeros from staying zeros
    return mixed((state ^ word) + golden_gamma);
}

/// How far the standard normal distribution is exceeded, on both sides together, with a given
/// probability: in parabolas, 32 for each halving of the probability. They are off by less than
/// 3e-7 deviations.
class NormalTails {
  public:
    NormalTails() {
        for (std::size_t i = 0; i < pieces_.size(); ++i)
            pieces_[i] = through(begin_of(i), begin_of(i + 1));
    }

    /// For probabilities from 2^-53 to below 1.
    [[nodiscard]] double operator()(double probability) const {
        const Piece& piece =
            pieces_[(std::bit_cast<std::uint64_t>(probability) >> piece_shift) - first_piece];
        return piece.a + probability * (piece.b + probability * piece.c);
    }

  private:
    struct Piece {
        double a;
        double b;
        double c;
    };

    static constexpr int halvings = 53;
    static constexpr int per_halving = 32;
    static constexpr int piece_shift = 52 - 5;  ///< leaves five bits of the mantissa
    static constexpr std::uint64_t first_piece = std::uint64_t{1023 - halvings} * per_halving;

    static double begin_of(std::size_t piece) {
        return std::bit_cast<double>((first_piece + piece) << piece_shift);
    }

    static double exceeded(double probability) {
        return std::numbers::sqrt2 * boost::math::erfc_inv(probability);
    }

    /// The parabola through the points that leave the least error between these ends.
    static Piece through(double begin, double end) {
        const double half = (end - begin) / 2.0;
        const double middle = begin + half;
        const double aside = half * std::numbers::sqrt3 / 2.0;
        const double low = exceeded(middle - aside);
        const double at_middle = exceeded(middle);
        const double high = exceeded(middle + aside);
        const double c = (high - 2.0 * at_middle + low) / (2.0 * aside * aside);
        const double slope = (high - low) / (2.0 * aside);
        return {at_middle - middle * (slope - middle * c), slope - 2.0 * middle * c, c};
    }

    std::array<Piece, halvings * per_halving> pieces_;
};

const NormalTails normal_tails;

}  // namespace

Chance::Chance(const ChanceKey& key)
    : state_(absorbed(absorbed(absorbed(absorbed(0, key.seed), key.sensor), key.scan),
                      static_cast<std::uint64_t>(key.purpose))) {}

double Chance::standard_normal(std::uint32_t beam) const {
    const double either_way = even(beam);
    return std::copysign(normal_tails(1.0 - std::abs(either_way)), either_way);
}

void Chance::standard_normals(std::uint32_t first_beam, std::span<float> numbers) const {
    for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] =
            static_cast<float>(standard_normal(first_beam + static_cast<std::uint32_t>(i)));
}

double Chance::even(std::uint32_t beam) const {
    // 53 random bits and a half: the middle of one of 2^53 equal intervals, so never an end.
    const auto bits = static_cast<std::int64_t>(absorbed(state_, beam)) >> 11;
    return (static_cast<double>(bits) + 0.5) * 0x1p-52;
}

}  // namespace scipd::sim
