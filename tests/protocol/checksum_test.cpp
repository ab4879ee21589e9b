// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/checksum.h"

#include <gtest/gtest.h>

namespace scipd::protocol {
namespace {

// Every line here with its sum comes from a recording of a real scanner.
TEST(Checksum, IsThatOfRecordedLines) {
    EXPECT_EQ(checksum("00"), 'P');
    EXPECT_EQ(checksum("99"), 'b');
    EXPECT_EQ(checksum("0E"), 'e');
    EXPECT_EQ(checksum("02"), 'R');
    EXPECT_EQ(checksum("MODL:URG-04LX(Hokuyo Automatic Co.,Ltd.)"), 'N');
    EXPECT_EQ(checksum("SCSP:Initial(600[rpm])<-Default setting by user"), 'A');
    EXPECT_EQ(checksum("JUGn"), 'D');
    EXPECT_EQ(checksum("06806806706105m05m05h05c05c05c05`05]05Z05W05W05U05S05O05S05P05P0"), '_');
}

TEST(Checksum, OfNothingIsZero) {
    EXPECT_EQ(checksum(""), '0');
}

TEST(Checksum, TakesBytesAsUnsigned) {
    EXPECT_EQ(checksum("\xff"), 'o');
}

}  // namespace
}  // namespace scipd::protocol
