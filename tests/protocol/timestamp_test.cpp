// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/timestamp.h"

#include <gtest/gtest.h>

namespace scipd::protocol {
namespace {

using namespace std::chrono_literals;

constexpr Uptime wrap = 16'777'216ms;  // 4 h 39 min 37.216 s

TEST(Timestamp, CountsWholeMillisecondsSinceZero) {
    EXPECT_EQ(timestamp_ms(0ms, 0ms), 0U);
    EXPECT_EQ(timestamp_ms(1'999'999ns, 0ms), 1U);
    EXPECT_EQ(timestamp_ms(2ms, 0ms), 2U);
    EXPECT_EQ(timestamp_ms(1000ms, 300ms), 700U);
}

TEST(Timestamp, WrapsAfter24Bits) {
    EXPECT_EQ(timestamp_ms(wrap - 1ms, 0ms), 16'777'215U);
    EXPECT_EQ(timestamp_ms(wrap, 0ms), 0U);
    EXPECT_EQ(timestamp_ms(3 * wrap + 5ms, 0ms), 5U);
    EXPECT_EQ(timestamp_ms(wrap, 1ms), 16'777'215U);
}

TEST(Timestamp, OfAnInstantBeforeZeroReadsAsItsWrap) {
    EXPECT_EQ(timestamp_ms(9ms, 10ms), 16'777'215U);
    EXPECT_EQ(timestamp_ms(9ms + 1ns, 10ms), 16'777'215U);
}

// The spellings of recorded replies.
TEST(Timestamp, IsSpelledAsRecorded) {
    EXPECT_EQ(encoded_timestamp(6'968'830ms, 0ms), "JUGn");
    EXPECT_EQ(encoded_timestamp(4'821'609ms, 0ms), "BI9Y");
    EXPECT_EQ(hexadecimal_timestamp(0x6A5404 * 1ms, 0ms), "6A5404");
    EXPECT_EQ(hexadecimal_timestamp(0x1957 * 1ms, 0ms), "001957");
    EXPECT_EQ(encoded_timestamp(wrap - 1ms, 0ms), "oooo");
    EXPECT_EQ(hexadecimal_timestamp(wrap - 1ms, 0ms), "FFFFFF");
    EXPECT_EQ(encoded_timestamp(wrap, 0ms), "0000");
}

TEST(Timestamp, OfTheNewestFirmwareCountsMicroseconds) {
    EXPECT_EQ(encoded_microseconds(7ms, 7ms), "00000000000");
    EXPECT_EQ(encoded_microseconds(7ms + 1234us + 999ns, 7ms), "000000000CB");
    EXPECT_EQ(encoded_microseconds(wrap, 0ms), "00000?X0000");  // 16777216000 us
}

}  // namespace
}  // namespace scipd::protocol
