// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mvsim/formula.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const Variables some{{"N", "3"}, {"half", "0.5"}, {"word", "oak"}};

double of(const std::string& text) {
    return formula(text, some);
}

TEST(Formula, BindsAsArithmeticDoes) {
    EXPECT_EQ(of("1+2*3"), 7);
    EXPECT_EQ(of("(1+2)*3"), 9);
    EXPECT_EQ(of("8-4-2"), 2);
    EXPECT_EQ(of("16/4/2"), 2);
    EXPECT_EQ(of("7 % 4"), 3);
    EXPECT_EQ(of("2^3^2"), 512);
    EXPECT_EQ(of("-2^2"), -4);
    EXPECT_EQ(of("1 < 2 and 2 < 1"), 0);
    EXPECT_EQ(of("0 or 2 >= 2"), 1);
}

TEST(Formula, KnowsVariablesAndFunctions) {
    EXPECT_EQ(of("N * half"), 1.5);
    EXPECT_DOUBLE_EQ(of("2*sin(pi/6)"), 1.0);
    EXPECT_DOUBLE_EQ(of("deg2rad(180)"), std::numbers::pi);
    EXPECT_DOUBLE_EQ(of("atan2(1, 1)"), std::numbers::pi / 4);
    EXPECT_EQ(of("max(1, N, 2) - min(4, half)"), 2.5);
    EXPECT_EQ(of("if(N == 3, 10, 20)"), 10);
}

TEST(Formula, SaysWhatCannotBeCalculated) {
    const auto refusal = [](const std::string& text, const std::string& why) {
        EXPECT_THAT([&] { of(text); }, ThrowsMessage<std::invalid_argument>(HasSubstr(why)));
    };
    refusal("1+", "wants a number");
    refusal("(1", "not closed");
    refusal("1 2", "cannot go on with");
    refusal("nothing", "there is no variable");
    refusal("word", "is no number");
    refusal("system(1)", "not known here");
    refusal(std::string(100, '('), "nested too deeply");
}

TEST(Substituted, PutsValuesInTheirPlaces) {
    EXPECT_EQ(substituted("no more than this", some), "no more than this");
    EXPECT_EQ(substituted("${word} ${N}", some), "oak 3");
    EXPECT_EQ(substituted("${gone|pine}", some), "pine");
    EXPECT_EQ(substituted("$f{N+1}", some), "4");
    EXPECT_EQ(substituted("$f{${N}*2} m", some), "6 m");
    EXPECT_THAT([] { substituted("${gone}", some); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("there is no variable")));
    EXPECT_THAT([] { substituted("${N", some); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("not closed")));
}

}  // namespace
}  // namespace scipd::sim
