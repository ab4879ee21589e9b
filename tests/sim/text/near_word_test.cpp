// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/text/near_word.h"

#include <array>

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

TEST(NearWord, IsTheOneThatTakesFewestLetters) {
    constexpr std::array<std::string_view, 4> known{"--scene", "--seed", "--pose", "--poses"};
    EXPECT_EQ(meant("--sceen", known), "--scene");
    EXPECT_EQ(meant("--scenes", known), "--scene");
    EXPECT_EQ(meant("--pose", known), "--pose");
    EXPECT_EQ(meant("--posess", known), "--poses");
    EXPECT_EQ(meant("--radar", known), std::nullopt);
    EXPECT_EQ(meant(std::string(40, '-'), known), std::nullopt);
    EXPECT_EQ(meant("--scene", {}), std::nullopt);
}

TEST(NearWord, CountsNoCase) {
    constexpr std::array<std::string_view, 2> known{"UST-20LX", "UST-10LX"};
    EXPECT_EQ(meant("ust-10lx", known), "UST-10LX");
    EXPECT_EQ(meant("ust10lx", known), "UST-10LX");
    EXPECT_EQ(meant("sick-tim", known), std::nullopt);
}

TEST(NearWord, OfThreeLettersAllowsForOneSlip) {
    constexpr std::array<std::string_view, 1> known{"map"};
    EXPECT_EQ(meant("mpa", known), std::nullopt);
    EXPECT_EQ(meant("maps", known), "map");
}

}  // namespace
}  // namespace scipd::sim
