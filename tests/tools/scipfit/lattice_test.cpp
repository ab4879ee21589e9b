// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The steps in which distances are told: any that were put in are found, and where they do not
// show, no number is told.
#include "tools/scipfit/lattice.h"

#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace scipd::tools {
namespace {

/// Walls that go from 1 m to `last_mm`, read with noise and then told as that.
ScanTable told(const std::function<double(double)>& as, double last_mm = 4000.0) {
    constexpr std::size_t beams = 500;
    constexpr std::size_t scans = 200;
    std::mt19937_64 chance(7);
    std::normal_distribution<double> noise(0.0, 6.0);
    ScanTable readings{.beams = beams, .whole_mm = true};
    for (std::size_t i = 0; i < scans * beams; ++i) {
        const double place = static_cast<double>(i % beams) / beams;
        const double mm = 1000.0 + place * (last_mm - 1000.0) + noise(chance);
        readings.ranges_mm.push_back(static_cast<float>(std::round(as(mm))));
    }
    return readings;
}

ScanTable in_steps_of(double spacing_mm, double last_mm = 4000.0) {
    return told([=](double mm) { return spacing_mm * std::round(mm / spacing_mm); }, last_mm);
}

TEST(Lattice, IsFoundWhateverItsSpacing) {
    for (const double spacing_mm : {1.5, 1.8, 2.0, 2.5, 3.0, 3.5, 4.0, 4.6, 5.0, 7.0, 10.0, 25.0}) {
        const Lattice found = lattice_of(in_steps_of(spacing_mm));
        EXPECT_TRUE(found.known) << spacing_mm;
        EXPECT_NEAR(found.spacing_mm, spacing_mm, 0.002) << spacing_mm;
        EXPECT_GT(found.missing, 0U) << spacing_mm;
    }
}

TEST(Lattice, IsNoneWhereAnyMillimetreOccurs) {
    const Lattice found = lattice_of(in_steps_of(1.0));
    EXPECT_TRUE(found.known);
    EXPECT_EQ(found.spacing_mm, 0.0);
}

TEST(Lattice, IsNotKnownOfOneShortWall) {
    EXPECT_FALSE(lattice_of(in_steps_of(25.0, 1050.0)).known);
    EXPECT_FALSE(lattice_of(in_steps_of(1.0, 1010.0)).known);
}

/// Steps that do not begin at 0 are none that scipd has.
TEST(Lattice, IsNotKnownOfStepsThatBeginElsewhere) {
    const auto beside = [](double mm) { return 5.0 * std::round(mm / 5.0) + 2.0; };
    EXPECT_FALSE(lattice_of(told(beside)).known);
}

}  // namespace
}  // namespace scipd::tools
