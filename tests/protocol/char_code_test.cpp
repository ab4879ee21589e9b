// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/char_code.h"

#include <gtest/gtest.h>

namespace scipd::protocol {
namespace {

std::string encoded(std::uint64_t value, int width) {
    std::string text;
    append_encoded(text, value, width);
    return text;
}

// The examples of the UST protocol document and of recordings.
TEST(CharCode, WritesWhatTheDocumentsWrite) {
    EXPECT_EQ(encoded(1234, 2), "CB");
    EXPECT_EQ(encoded(4095, 2), "oo");
    EXPECT_EQ(encoded(5432, 3), "1Dh");
    EXPECT_EQ(encoded(4, 3), "004");
    EXPECT_EQ(encoded(65533, 3), "?om");
    EXPECT_EQ(encoded(60000, 3), ">YP");
    EXPECT_EQ(encoded(16000000, 4), "m2@0");
    EXPECT_EQ(encoded(16777215, 4), "oooo");
    EXPECT_EQ(encoded(6968830, 4), "JUGn");  // a URG-04LX's time stamp
}

TEST(CharCode, KeepsTheLowBitsOfWhatDoesNotFit) {
    EXPECT_EQ(encoded(4096 + 1234, 2), "CB");
}

TEST(CharCode, ReadsBackEverySmallNumber) {
    for (const int width : {1, 2, 3, 4}) {
        // All of 1, 2 and 3 characters; of 4, every 61st.
        const std::uint64_t stride = width < 4 ? 1 : 61;
        for (std::uint64_t value = 0; value <= max_encoded(width); value += stride)
            ASSERT_EQ(decode(encoded(value, width)), value) << "width " << width;
    }
}

TEST(CharCode, ReadsBackWhatItWroteInAnyWidth) {
    for (int width = 4; width <= 11; ++width) {
        std::uint64_t value = 1;
        for (int i = 0; i < 10'000; ++i) {
            value = value * 6364136223846793005U + 1442695040888963407U;  // Knuth's MMIX
            const std::uint64_t fitting = value & max_encoded(width);
            ASSERT_EQ(decode(encoded(fitting, width)), fitting) << "width " << width;
        }
        for (const std::uint64_t edge : {std::uint64_t{0}, max_encoded(width)})
            EXPECT_EQ(decode(encoded(edge, width)), edge) << "width " << width;
    }
}

// Every text of two characters is a number of its own, so that writing and reading are each other's
// inverse and not only the one the other's.
TEST(CharCode, WritesBackWhatItRead) {
    for (char first = '0'; first <= 'o'; ++first) {
        for (char second = '0'; second <= 'o'; ++second) {
            const std::string text = {first, second};
            EXPECT_EQ(encoded(decode(text).value(), 2), text);
        }
    }
}

TEST(CharCode, RefusesOtherCharacters) {
    EXPECT_EQ(decode(""), std::nullopt);
    EXPECT_EQ(decode("0/"), std::nullopt);
    EXPECT_EQ(decode("p0"), std::nullopt);
    EXPECT_EQ(decode("\xff"), std::nullopt);
}

// Eleven characters are 66 bits.
TEST(CharCode, RefusesWhatDoesNotFitInto64Bits) {
    EXPECT_EQ(decode("00000000001"), 1U);
    EXPECT_EQ(decode("?oooooooooo"), max_encoded(11));
    EXPECT_EQ(decode("@0000000000"), std::nullopt);
    EXPECT_EQ(decode("000000000001"), 1U);
    EXPECT_EQ(decode("@00000000000"), std::nullopt);
}

}  // namespace
}  // namespace scipd::protocol
