// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What neighbouring beams share of their noise, against the closed forms of a moving sum and of the
// median of five normal numbers. Seeds are fixed; bounds are five standard errors.
#include "sim/sensor/noise_row.h"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

constexpr double beam_rad = 2.0 * std::numbers::pi / 1440.0;
constexpr std::size_t row_beams = 400;
constexpr int scans = 400;
constexpr Smoothing mixing{.next = 0.3, .after_next = 0.1};
constexpr Smoothing median{.median_of_five = true};

struct Seen {
    double range_m;
    ObjectId object = 0;
};
/// What a beam sees.
using View = std::function<Seen(std::size_t)>;

const View flat = [](std::size_t) { return Seen{3.0}; };

NoiseRow row_of(const View& view, const Smoothing& smoothing, int scan, std::uint32_t rank = 0) {
    NoiseRow row(row_beams, rank);
    for (std::size_t beam = 0; beam < row_beams; ++beam) {
        const auto [range_m, object] = view(beam);
        if (std::isfinite(range_m)) row.set(beam, static_cast<float>(range_m), 0.01F, object);
    }
    row.draw(smoothing, beam_rad, Chance({.seed = 4, .scan = static_cast<std::uint64_t>(scan)}));
    return row;
}

/// Moments over scans and over the beams from `begin` to before `end`.
struct Shared {
    double deviation_m = 0.0;
    std::array<double, 6> correlation{};  ///< by distance
};

Shared shared(const View& view, const Smoothing& smoothing, std::size_t begin = 0,
              std::size_t end = row_beams - 5) {
    std::array<double, 6> products{};
    for (int scan = 0; scan < scans; ++scan) {
        const NoiseRow row = row_of(view, smoothing, scan);
        for (std::size_t beam = begin; beam < end; ++beam) {
            for (std::size_t apart = 0; apart < products.size(); ++apart)
                products[apart] += row.noise_m(beam) * row.noise_m(beam + apart);
        }
    }
    Shared shared;
    shared.deviation_m = std::sqrt(products[0] / (scans * double(end - begin)));
    for (std::size_t apart = 0; apart < products.size(); ++apart)
        shared.correlation[apart] = products[apart] / products[0];
    return shared;
}

TEST(NoiseRow, SharesAsMuchAsAMovingSum) {
    const double own = 1.0 + 2.0 * (0.09 + 0.01);
    const std::array<double, 6> expected{1.0,
                                         (2.0 * 0.3 + 2.0 * 0.3 * 0.1) / own,
                                         (2.0 * 0.1 + 0.3 * 0.3) / own,
                                         2.0 * 0.3 * 0.1 / own,
                                         0.1 * 0.1 / own,
                                         0.0};
    const Shared is = shared(flat, mixing);
    EXPECT_NEAR(is.deviation_m, 0.01, 1e-4);
    for (std::size_t apart = 0; apart < expected.size(); ++apart)
        EXPECT_NEAR(is.correlation[apart], expected[apart], 0.015) << apart;
}

TEST(NoiseRow, KeepsTheDeviationWithoutSharing) {
    const Shared is = shared(flat, {});
    EXPECT_NEAR(is.deviation_m, 0.01, 1e-4);
    for (std::size_t apart = 1; apart < 6; ++apart)
        EXPECT_NEAR(is.correlation[apart], 0.0, 0.015) << apart;
}

// Two medians of five independent numbers that share four, three, two and one of them correlate by
// 0.69, 0.49, 0.31, 0.15, from 10^7 draws in another language. Half of all neighbours are equal.
TEST(NoiseRow, SharesAsMuchAsMediansOfFive) {
    const std::array<double, 6> expected{1.0, 0.69, 0.49, 0.31, 0.15, 0.0};
    const Shared is = shared(flat, median);
    EXPECT_NEAR(is.deviation_m, 0.01, 2e-4);
    for (std::size_t apart = 0; apart < expected.size(); ++apart)
        EXPECT_NEAR(is.correlation[apart], expected[apart], 0.02) << apart;
    int equal = 0;
    for (int scan = 0; scan < scans; ++scan) {
        const NoiseRow row = row_of(flat, median, scan);
        for (std::size_t beam = 1; beam < row_beams; ++beam)
            equal += row.noise_m(beam) == row.noise_m(beam - 1) ? 1 : 0;
    }
    EXPECT_NEAR(equal / (scans * double(row_beams - 1)), 0.5, 0.1);
}

// On a slope as steep as this the middle beam of five is always the median.
TEST(NoiseRow, LeavesAllNoiseOnASteepSlope) {
    const View slope = [](std::size_t beam) { return Seen{3.0 + 0.1 * double(beam)}; };
    const Shared is = shared(slope, median);
    EXPECT_NEAR(is.deviation_m, 0.01 / 0.53557, 2e-4);
    EXPECT_NEAR(is.correlation[1], 0.0, 0.015);
}

// The first and last beams of a face are as noisy as the others.
TEST(NoiseRow, IsAsNoisyAtTheEndOfAFace) {
    for (const Smoothing& smoothing : {mixing, median}) {
        EXPECT_NEAR(shared(flat, smoothing, 0, 1).deviation_m, 0.01, 0.002);
        const View narrow = [](std::size_t beam) { return Seen{3.0, ObjectId(beam)}; };
        const Shared alone = shared(narrow, smoothing);
        EXPECT_NEAR(alone.deviation_m, 0.01, 2e-4);
        EXPECT_NEAR(alone.correlation[1], 0.0, 0.015);
    }
}

struct Border {
    const char* what;
    View view;  ///< beams before 200 see one face, those from 200 on another one
};

class Borders : public testing::TestWithParam<Border> {};

double shared_across(const View& view, const Smoothing& smoothing) {
    double product = 0.0;
    double square = 0.0;
    for (int scan = 0; scan < 4 * scans; ++scan) {
        const NoiseRow row = row_of(view, smoothing, scan);
        for (std::size_t before = 198; before < 200; ++before) {
            for (std::size_t behind = 200; behind < 202; ++behind)
                product += row.noise_m(before) * row.noise_m(behind) / 4.0;
            square += row.noise_m(before) * row.noise_m(before) / 2.0;
        }
    }
    return product / square;
}

TEST_P(Borders, AreNotCrossed) {
    for (const Smoothing& smoothing : {mixing, median})
        EXPECT_NEAR(shared_across(GetParam().view, smoothing), 0.0, 0.07);
}

/// A wall along which the angle to the middle grows, up to its end at beam 200.
double wall_m(std::size_t beam, double corner_rad) {
    const double aside_rad = (double(beam) - 199.5) * beam_rad;
    return 2.0 / std::cos(corner_rad + (beam < 200 ? aside_rad : -aside_rad));
}

Seen another_object(std::size_t beam) {
    return {3.0, beam < 200 ? 1U : 2U};
}

Seen a_jump(std::size_t beam) {
    return {beam < 200 ? 3.0 : 3.1, 1};
}

Seen a_corner(std::size_t beam) {
    return {wall_m(beam, 0.785), 1};
}

INSTANTIATE_TEST_SUITE_P(Of, Borders,
                         testing::Values(Border{"another_object", another_object},
                                         Border{"a_jump", a_jump}, Border{"a_corner", a_corner}),
                         [](const auto& border) { return border.param.what; });

// A chance of each beam alone: it does not matter how many others are looked at.
TEST(NoiseRow, DependsOnTheFaceAlone) {
    for (const Smoothing& smoothing : {mixing, median}) {
        const View partly = [](std::size_t beam) {
            return beam < 100 ? Seen{std::numeric_limits<double>::infinity()} : Seen{3.0};
        };
        const NoiseRow all = row_of(flat, smoothing, 7);
        const NoiseRow some = row_of(partly, smoothing, 7);
        for (std::size_t beam = 102; beam < row_beams; ++beam)
            EXPECT_EQ(all.noise_m(beam), some.noise_m(beam)) << beam;
    }
}

TEST(NoiseRow, HasOtherChancesForEachEchoOfABeam) {
    const NoiseRow near = row_of(flat, mixing, 7, 0);
    const NoiseRow far = row_of(flat, mixing, 7, 1);
    for (std::size_t beam = 0; beam < row_beams; ++beam)
        EXPECT_NE(near.noise_m(beam), far.noise_m(beam));
}

}  // namespace
}  // namespace scipd::sim
