// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which parameters least squares can tell, where closed form says it.
#include "tools/scipfit/rank.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scipd::tools {
namespace {

/// How ranges r = s d / cos(a - n) + o go by the logarithm of d and of the scale s, by n and by o,
/// in units of 5 mm of noise. d and s appear as their product alone.
Jacobian one_plane(double from_rad, double to_rad) {
    constexpr double distance_m = 2.0;
    constexpr double sigma_m = 0.005;
    Jacobian jacobian{.columns = 4, .values = {}};
    for (double angle = from_rad; angle < to_rad; angle += 0.01) {
        const double range = distance_m / std::cos(angle) / sigma_m;
        jacobian.values.insert(jacobian.values.end(),
                               {range, range, -range * std::tan(angle), 1.0 / sigma_m});
    }
    return jacobian;
}

// Ceres' covariance with a rank of its own choice reported 0.027 +- 0.0009 here.
TEST(Rank, DoesNotKnowTheScaleOfOnePlane) {
    EXPECT_EQ(known_parameters(one_plane(-0.8, 0.8)),
              (std::vector<bool>{false, false, true, true}));
}

TEST(Rank, KnowsNothingWithoutRows) {
    EXPECT_EQ(known_parameters({.columns = 2, .values = {}}), (std::vector<bool>{false, false}));
}

TEST(Rank, KnowsWhatOneRowTellsAlone) {
    EXPECT_EQ(known_parameters({.columns = 1, .values = {3.0}}), std::vector<bool>{true});
    EXPECT_EQ(known_parameters({.columns = 1, .values = {0.3}}), std::vector<bool>{false});
    EXPECT_EQ(known_parameters({.columns = 2, .values = {3.0, 3.0}}),
              (std::vector<bool>{false, false}));
}

}  // namespace
}  // namespace scipd::tools
