// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What people write who think in degrees and millimetres, and what they write who do not.
#include "sim/text/likely_unit.h"

#include <vector>

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

using Numbers = std::vector<double>;

TEST(LikelyUnit, KnowsDegreesByATurnAndMoreOfThem) {
    EXPECT_EQ(degrees_for_radians(Numbers{0, 0, 90}),
              "0, 0, 90 looks like degrees, but angles are radians; did you mean 0, 0, 1.5708?");
    EXPECT_EQ(degrees_for_radians(Numbers{-180}),
              "-180 looks like degrees, but angles are radians; did you mean -3.1416?");
    EXPECT_EQ(degrees_for_radians(Numbers{0, 2, 22.5}),
              "0, 2, 22.5 looks like degrees, but angles are radians; did you mean 0, 0.034907, "
              "0.3927?");
    for (const double angle : {7.0, 10.0, 45.0, 270.0, 359.9, 720.0})
        EXPECT_TRUE(degrees_for_radians(Numbers{angle})) << angle;
}

TEST(LikelyUnit, LeavesRadiansAlone) {
    // A robot that has turned round and round, and multiples of pi as people round them.
    for (const double angle : {0.0, 1.57, 3.14159, -3.1, 5.0, 6.2, 6.2831, 7.85, 7.853982, 9.42,
                               12.566, 31.415926, 1234.56789})
        EXPECT_FALSE(degrees_for_radians(Numbers{angle})) << angle;
    EXPECT_FALSE(degrees_for_radians(Numbers{0, 1.5708, 90}));
    EXPECT_FALSE(degrees_for_radians(Numbers{}));
}

TEST(LikelyUnit, KnowsWhatCouldBeMillimetres) {
    EXPECT_TRUE(could_be_millimetres(Numbers{200, 0, 250}));
    EXPECT_TRUE(could_be_millimetres(Numbers{0, -5, 87.5}));
    EXPECT_FALSE(could_be_millimetres(Numbers{0.2, 0, 0.25}));
    EXPECT_FALSE(could_be_millimetres(Numbers{12, 30, 2}));
    EXPECT_FALSE(could_be_millimetres(Numbers{120, 80, 0.3}));
    EXPECT_FALSE(could_be_millimetres(Numbers{120.25, 80, 2}));
    EXPECT_EQ(millimetres_for_metres(Numbers{200, 0, 250}),
              "200, 0, 250 looks like millimetres, but lengths are metres; did you mean 0.2, 0, "
              "0.25?");
}

}  // namespace
}  // namespace scipd::sim
