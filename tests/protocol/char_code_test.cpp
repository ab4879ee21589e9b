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

TEST(CharCode, ReadsBackWhatItWrote) {
    for (const int width : {1, 2, 3, 4, 10}) {
        for (std::uint64_t value = 0; value < max_encoded(width); value = value * 5 + 3)
            EXPECT_EQ(decode(encoded(value, width)), value) << "width " << width;
        EXPECT_EQ(decode(encoded(max_encoded(width), width)), max_encoded(width));
    }
}

TEST(CharCode, RefusesOtherCharacters) {
    EXPECT_EQ(decode(""), std::nullopt);
    EXPECT_EQ(decode("0/"), std::nullopt);
    EXPECT_EQ(decode("p0"), std::nullopt);
    EXPECT_EQ(decode("\xff"), std::nullopt);
    EXPECT_EQ(decode("00000000000"), std::nullopt);  // 11 do not fit into 64 bits
}

}  // namespace
}  // namespace scipd::protocol
