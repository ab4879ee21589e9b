// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/aggregation.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

glm::vec3 aside(double angle_rad) {
    return {std::cos(angle_rad), std::sin(angle_rad), 0.0};
}

/// The axis, half way out, and both ends of the rim: weights of 1, exp(-1) and exp(-4) twice.
const std::vector<glm::vec3> four_beams{aside(0), aside(0.1), aside(0.2), aside(-0.2)};

/// Zero: nothing is met.
std::vector<Hit> hits_at(const std::vector<float>& ranges_m) {
    std::vector<Hit> hits;
    for (const float range_m : ranges_m)
        hits.push_back(range_m > 0 ? Hit{range_m, 1.0F, 0, 0} : Hit{});
    return hits;
}

std::optional<std::size_t> chosen(Aggregate kind, const std::vector<float>& ranges_m) {
    return Aggregation(kind, four_beams).choose(hits_at(ranges_m));
}

TEST(Aggregation, TakesTheNearest) {
    EXPECT_EQ(chosen(Aggregate::nearest, {3, 2, 4, 1}), 3U);
    EXPECT_EQ(chosen(Aggregate::nearest, {0, 2, 0, 5}), 1U);
    EXPECT_EQ(chosen(Aggregate::nearest, {2, 2, 2, 2}), 0U);
}

TEST(Aggregation, HearsTheAxisRatherThanTheRim) {
    // 0.018 of 1.40 is not a twentieth; 0.386 is, and so is 1.
    EXPECT_EQ(chosen(Aggregate::weighted, {3, 2, 4, 1}), 1U);
    EXPECT_EQ(chosen(Aggregate::weighted, {1, 2, 3, 4}), 0U);
    EXPECT_EQ(chosen(Aggregate::weighted, {4, 0, 1, 2}), 0U);
    // 0.018 of 0.37 is not one either, and both ends of the rim, 0.037 of 0.40, are.
    EXPECT_EQ(chosen(Aggregate::weighted, {0, 4, 1, 0}), 1U);
    EXPECT_EQ(chosen(Aggregate::weighted, {0, 4, 1, 2}), 3U);
}

TEST(Aggregation, HearsWhatIsAloneHoweverWeak) {
    EXPECT_EQ(chosen(Aggregate::weighted, {0, 0, 0, 7}), 3U);
}

TEST(Aggregation, IsNothingWhereNothingIsMet) {
    EXPECT_FALSE(chosen(Aggregate::nearest, {0, 0, 0, 0}));
    EXPECT_FALSE(chosen(Aggregate::weighted, {0, 0, 0, 0}));
}

TEST(Aggregation, NeedsNoCone) {
    const std::vector<glm::vec3> one{aside(0)};
    EXPECT_EQ(Aggregation(Aggregate::weighted, one).choose(hits_at({5})), 0U);
}

}  // namespace
}  // namespace scipd::sim
