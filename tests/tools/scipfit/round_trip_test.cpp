// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What was put into scipd's sensor model comes out of the fit. scipfit_round_trips looks at 200.
#include "tests/tools/scipfit/round_trip.h"

#include <gtest/gtest.h>

namespace scipd::tests {
namespace {

TEST(RoundTrip, HoldsTheTruthInItsIntervals) {
    RoundTrip result;
    for (std::uint64_t seed = 1; seed <= 6; ++seed)
        make_round_trip(seed, result);
    int inside = 0;
    int all = 0;
    for (const auto& [parameter, hits] : result.parameters) {
        inside += hits.inside;
        all += hits.all;
    }
    EXPECT_GT(all, 40);
    // 95 % of them, and three standard errors less: seeds are fixed, but compilers differ.
    EXPECT_GT(inside, 0.84 * all);
    EXPECT_EQ(result.unknown_told, 0);
    EXPECT_EQ(result.wrong_smoothing, 0);
    EXPECT_EQ(result.wrong_lattice, 0);
}

}  // namespace
}  // namespace scipd::tests
