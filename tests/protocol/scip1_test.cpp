// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Requests of SCIP 1.1. Replies and what becomes of the device are the dialogues' business.
#include "protocol/scip1.h"

#include <gtest/gtest.h>

#include "tests/protocol/test_profile.h"

namespace scipd::protocol {
namespace {

using namespace std::chrono_literals;
using Kind = Scip1Request::Kind;

DeviceProfile old_profile() {
    DeviceProfile profile = test_profile(Family::urg);
    profile.bit_rates = {19200, 57600};
    return profile;
}

TEST(Scip1, ReadsTheWindowOfAScan) {
    const Scip1Request request = parse_scip1("G00200903", old_profile());
    EXPECT_EQ(request.kind, Kind::scan);
    EXPECT_EQ(request.window.first, 2);
    EXPECT_EQ(request.window.last, 9);
    EXPECT_EQ(request.window.cluster, 3);
}

TEST(Scip1, ReadsTheRate) {
    EXPECT_EQ(parse_scip1("S0576000000000", old_profile()).bit_rate, 57600);
}

TEST(Scip1, KnowsNothingThatIsNotWhole) {
    for (const char* line : {"", "v", "V ", "G", "G00201003", "G009002 1", "G0020090", "S019200",
                             "S0123450000000", "L", "L2", "QT", "SCIP2", "SCIP2.0 "})
        EXPECT_EQ(parse_scip1(line, old_profile()).kind, Kind::unknown) << line;
}

TEST(Scip1, ADeviceThatPowersUpInItDoesSoAgain) {
    DeviceState device;
    device.power_up_in_scip1(0ms);
    EXPECT_TRUE(device.laser_on());
    EXPECT_EQ(operate_scip1(device, {.kind = Kind::choose_scip2}, 1ms), scip1_status::ok);
    EXPECT_FALSE(device.speaks_scip1());
    EXPECT_FALSE(device.laser_on());
    device.boot(1s, 2s);
    EXPECT_TRUE(device.speaks_scip1());
    EXPECT_TRUE(device.laser_on());
    EXPECT_EQ(device.laser_on_since(), 3s);
}

}  // namespace
}  // namespace scipd::protocol
