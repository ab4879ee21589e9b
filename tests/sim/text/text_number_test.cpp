// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/text/text_number.h"

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

using namespace std::chrono_literals;

TEST(Stamp, IsExactToTheNanosecond) {
    EXPECT_EQ(parse_stamp("0"), 0s);
    EXPECT_EQ(parse_stamp("1.5"), 1500ms);
    EXPECT_EQ(parse_stamp("-1.25"), -1250ms);
    EXPECT_EQ(parse_stamp(".5"), 500ms);
    EXPECT_EQ(parse_stamp("7."), 7s);
    // No double holds these.
    EXPECT_EQ(parse_stamp("1700000000.123456789"), 1700000000s + 123456789ns);
    EXPECT_EQ(parse_stamp("1403636579.763555584"), 1403636579s + 763555584ns);
    EXPECT_EQ(parse_stamp("0.1234567894"), 123456789ns);
    EXPECT_EQ(parse_stamp("0.9999999995"), 1s);
}

TEST(Stamp, HasAnExponentAndAUnit) {
    EXPECT_EQ(parse_stamp("1.70e+09"), 1700000000s);
    EXPECT_EQ(parse_stamp("25E-3"), 25ms);
    EXPECT_EQ(parse_stamp("1403636579763555584", -9), 1403636579s + 763555584ns);
    EXPECT_EQ(parse_stamp("12", -3), 12ms);
}

TEST(Stamp, IsNothingWhereItIsNoNumberOrTooLarge) {
    for (const char* text : {"", "-", ".", "x", "1 ", " 1", "1e", "1e99", "1.2.3", "--1", "nan",
                             "inf", "9000000001", "9e10", "99999999999999999999999999"})
        EXPECT_EQ(parse_stamp(text), std::nullopt) << text;
    EXPECT_EQ(parse_stamp("9000000000"), 9000000000s);
}

TEST(Number, IsAllOfTheTextAndFinite) {
    EXPECT_EQ(parse_number("-1.5e2"), -150.0);
    EXPECT_EQ(parse_number("0.1"), 0.1);
    EXPECT_EQ(parse_number("-1e-400"), 0.0);
    for (const char* text : {"", " 1", "1 ", "1x", "+1", "nan", "inf", "1e999", "0x10"})
        EXPECT_EQ(parse_number(text), std::nullopt) << text;
}

TEST(Numbers, AreAsManyAsAreWanted) {
    EXPECT_EQ(parse_numbers("1 -2.5\t+3e1\n", 3), (std::vector<double>{1, -2.5, 30}));
    EXPECT_EQ(parse_numbers("", 0), std::vector<double>{});
    for (const char* text : {"", "1 2", "1 2 3 4", "1 2 x", "1 2 3x", "1 2 nan", "1,2,3"})
        EXPECT_EQ(parse_numbers(text, 3), std::nullopt) << text;
}

TEST(Trimmed, IsWithoutTheBlanksAround) {
    EXPECT_EQ(trimmed(" \ta b\r\n"), "a b");
    EXPECT_EQ(trimmed("  "), "");
}

}  // namespace
}  // namespace scipd::sim
