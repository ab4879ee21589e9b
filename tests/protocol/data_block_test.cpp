// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/data_block.h"

#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "protocol/char_code.h"
#include "protocol/checksum.h"

namespace scipd::protocol {
namespace {

std::string block(const std::vector<std::uint32_t>& values, int width) {
    std::string text;
    append_data_block(text, values, width);
    return text;
}

// Character by character, as the documents say it.
std::string plain_block(const std::vector<std::uint32_t>& values, int width) {
    std::string characters;
    for (const std::uint32_t value : values)
        append_encoded(characters, value, width);
    std::string text;
    for (std::size_t begin = 0; begin < characters.size(); begin += 64) {
        const std::string line = characters.substr(begin, 64);
        text += line + checksum(line) + "\n";
    }
    return text;
}

// The first line of a URG-04LX's scan and the start of the next, with its own cut through the 22nd
// value.
TEST(DataBlock, CutsThroughValuesAsRecorded) {
    const std::vector<std::uint32_t> values = {392, 392, 391, 385, 381, 381, 376, 371,
                                               371, 371, 368, 365, 362, 359, 359, 357,
                                               355, 351, 355, 352, 352, 352};
    EXPECT_EQ(block(values, 3),
              "06806806706105m05m05h05c05c05c05`05]05Z05W05W05U05S05O05S05P05P0_\n"
              "5P5\n");
}

TEST(DataBlock, OfNothingIsNothing) {
    EXPECT_EQ(block({}, 3), "");
    EXPECT_EQ(data_block_size(0, 3), 0U);
}

TEST(DataBlock, FillsItsLastLineWithoutAnEmptyOneBehind) {
    const std::string text = block(std::vector<std::uint32_t>(64, 0), 3);
    EXPECT_EQ(text, std::string(64, '0') + "0\n" + std::string(64, '0') + "0\n" +
                        std::string(64, '0') + "0\n");
}

TEST(DataBlock, AppendsToWhatIsThere) {
    std::string text = "JUGnD\n";
    append_data_block(text, std::vector<std::uint32_t>{1234}, 2);
    EXPECT_EQ(text, "JUGnD\nCB5\n");
}

TEST(DataBlock, EqualsThePlainWayForAnyLength) {
    for (const int width : {2, 3}) {
        const std::uint32_t largest = static_cast<std::uint32_t>(max_encoded(width));
        std::vector<std::uint32_t> values;
        for (std::uint32_t length = 0; length <= 200; ++length) {
            EXPECT_EQ(block(values, width), plain_block(values, width))
                << length << " values of " << width;
            EXPECT_EQ(block(values, width).size(), data_block_size(length, width));
            values.push_back(length % 17 == 0 ? largest : length * 2654435761U % (largest + 1));
        }
    }
}

TEST(DataBlock, EqualsThePlainWayForEveryValue) {
    for (const int width : {2, 3}) {
        std::vector<std::uint32_t> values(max_encoded(width) + 1);
        std::iota(values.begin(), values.end(), 0U);
        EXPECT_TRUE(block(values, width) == plain_block(values, width)) << width << " characters";
    }
}

// Lengths of messages in recordings: URG-04LX GD, UTM-30LX ME, UST-20LX MD.
TEST(DataBlock, GivesMessagesTheirRecordedLength) {
    const auto message = [](std::size_t echo, std::size_t values) {
        return echo + 1 + 4 + 6 + data_block_size(values, 3) + 1;
    };
    EXPECT_EQ(message(12, 682), 2134U);
    EXPECT_EQ(message(12, 677), 2119U);
    EXPECT_EQ(message(15, 2 * 1081), 6717U);
    EXPECT_EQ(message(15, 726), 2275U);
}

}  // namespace
}  // namespace scipd::protocol
