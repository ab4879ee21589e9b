// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/shards/burdens.h"

#include <algorithm>
#include <cstdint>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using testing::ElementsAre;
using Burdens = std::vector<Burden>;

std::vector<double> loads(const Burdens& burdens, std::size_t shards) {
    std::vector<double> loads(shards, 0.0);
    const auto shard_of = spread(burdens, shards);
    for (std::size_t i = 0; i < burdens.size(); ++i)
        loads.at(shard_of[i]) += burdens[i].cost;
    return loads;
}

TEST(SpreadTest, PutsAllOnOneWhereThereIsOne) {
    EXPECT_THAT(spread(Burdens{{3.0, {}}, {1.0, {}}}, 1), ElementsAre(0, 0));
    EXPECT_THAT(spread(Burdens{}, 4), testing::IsEmpty());
}

TEST(SpreadTest, GivesEachTheNextOfAKind) {
    EXPECT_THAT(spread(Burdens(5, {1.0, {}}), 3), ElementsAre(0, 1, 2, 0, 1));
}

TEST(SpreadTest, PutsLargeOnesApart) {
    EXPECT_THAT(loads({{1, {}}, {1, {}}, {4, {}}, {1, {}}, {1, {}}, {4, {}}}, 2),
                ElementsAre(6, 6));
}

TEST(SpreadTest, LeavesThemWhereTheyAreHeld) {
    EXPECT_THAT(spread(Burdens{{9.0, 1}, {1.0, {}}, {1.0, 1}, {1.0, {}}}, 2),
                ElementsAre(1, 0, 1, 0));
}

// The bound is Graham's. The least that any spread reaches is the mean or the largest.
TEST(SpreadTest, IsNeverMuchWorseThanTheBest) {
    std::uint32_t chance = 1;
    const auto next = [&chance] { return chance = chance * 1664525U + 1013904223U; };
    for (int round = 0; round < 200; ++round) {
        Burdens burdens(1 + next() % 40U);
        double sum = 0.0;
        double largest = 0.0;
        for (Burden& burden : burdens) {
            burden.cost = 1.0 + next() % 1000U;
            sum += burden.cost;
            largest = std::max(largest, burden.cost);
        }
        const std::size_t shards = 1 + next() % 7U;
        const double mean = sum / static_cast<double>(shards);
        // What comes last finds a shard that has no more than the mean.
        EXPECT_LE(std::ranges::max(loads(burdens, shards)), mean + largest);
    }
}

}  // namespace
}  // namespace scipd::daemon
