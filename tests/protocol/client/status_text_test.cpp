// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What statuses mean: SCIP 2.0 specification C-42-03320B, pages 10 to 23.
#include "protocol/client/status_text.h"

#include <gtest/gtest.h>

namespace scipd::protocol::client {
namespace {

std::string said(const std::string& echo, const std::string& status) {
    return describe_status({.echo = echo, .status = status});
}

TEST(StatusText, OfScansTellsWhatIsWrongWithTheParameters) {
    EXPECT_EQ(said("GD0009000101", "05"), "status 05: the last step lies before the first");
    EXPECT_EQ(said("MD0009000101000;a", "05"), "status 05: the last step lies before the first");
    EXPECT_EQ(said("MD000x000101000", "01"), "status 01: the first step is no number");
    EXPECT_EQ(said("ME0000000101x00", "06"), "status 06: the interval is no number");
    EXPECT_EQ(said("HD0000099901", "04"), "status 04: the scanner has no such step");
}

TEST(StatusText, DependsOnTheCommand) {
    EXPECT_EQ(said("BM", "01"), "status 01: the laser is out of order");
    EXPECT_EQ(said("DB01", "05"), "status 05: the scanner is in a real error state");
    EXPECT_EQ(said("SS019200", "03"), "status 03: this is the present value");
    EXPECT_EQ(said("VV", "05"), "status 05");
}

// C-42-03320B calls 0D an undefined command and 0F insufficient parameters; later models, a request
// that is too long and a command that is not supported.
TEST(StatusText, NamesBothMeaningsWhereDialectsDiffer) {
    EXPECT_EQ(said("GE0000000101", "0D"),
              "status 0D: the request is too long; of some firmwares, the command is unknown");
    EXPECT_EQ(said("GE0000000101", "0F"),
              "status 0F: the scanner does not support the command; of some firmwares, parameters "
              "are missing");
}

TEST(StatusText, HasTheRangesOfTrouble) {
    EXPECT_EQ(said("MD0000000101000", "21"), "status 21: the stream pauses to verify an error");
    EXPECT_EQ(said("MD0000000101000", "49"), "status 49: the stream pauses to verify an error");
    EXPECT_EQ(said("MD0000000101000", "50"), "status 50: the laser or the motor is out of order");
    EXPECT_EQ(said("MD0000000101000", "97"), "status 97: the laser or the motor is out of order");
    EXPECT_EQ(said("MD0000000101000", "98"), "status 98: the stream goes on");
}

TEST(StatusText, OfAnUnknownCommandOrStatusSaysWhatIsKnown) {
    EXPECT_EQ(said("XX", "0E"),
              "status 0E: the scanner does not know the command, or is in time-adjust mode");
    EXPECT_EQ(said("XX", "20"), "status 20");
    EXPECT_EQ(said("", "??"), "status ??");
}

}  // namespace
}  // namespace scipd::protocol::client
