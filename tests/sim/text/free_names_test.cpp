// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/text/free_names.h"

#include <ctime>
#include <string>

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

double cpu_s() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

/// How long it takes to name so many things of one name.
double named_in_s(int things) {
    FreeNames names{':', 1};
    const double begun_s = cpu_s();
    for (int i = 0; i < things; ++i)
        (void)names.take("box");
    return cpu_s() - begun_s;
}

TEST(FreeNames, AreNumberedInOrder) {
    FreeNames names{'_', 2};
    EXPECT_EQ(names.take("box"), "box");
    EXPECT_EQ(names.take("box"), "box_2");
    EXPECT_EQ(names.take("ball"), "ball");
    EXPECT_EQ(names.take("box_4"), "box_4");
    EXPECT_EQ(names.take("box"), "box_3");
    EXPECT_EQ(names.take("box"), "box_5");
    EXPECT_EQ(names.take("box_4"), "box_4_2");
}

TEST(FreeNames, OfThingsWithLongNamesDiffer) {
    FreeNames names{':', 1};
    const std::string said(100, 'x');
    const std::string first = names.take(said);
    const std::string second = names.take(said);
    EXPECT_NE(first, second);
    EXPECT_LE(second.size(), longest_name);
}

// Twenty times as many take twenty times as long, and not four hundred times.
TEST(FreeNames, TakeAsLongForEachOfMany) {
    named_in_s(2'000);
    const double few_s = named_in_s(2'000);
    EXPECT_LT(named_in_s(40'000), 100 * few_s + 0.05);
}

}  // namespace
}  // namespace scipd::sim
