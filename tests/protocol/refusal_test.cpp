// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/refusal.h"

#include <gtest/gtest.h>

#include "tests/protocol/test_profile.h"

namespace scipd::protocol {
namespace {

std::optional<Status> refusal_of(const std::string& line, State state, LinkKind link,
                                 const DeviceProfile& profile, Trouble trouble = Trouble::none) {
    return protocol::refusal_of(parse_request({line}, profile), state, trouble, link, profile);
}

TEST(Refusal, OfTheLinesRateIsThatOfATtyOnATty) {
    for (const Family family : {Family::ethernet_multi_echo, Family::ust}) {
        const DeviceProfile profile = test_profile(family);
        for (const State state : {State::standby, State::measuring, State::streaming}) {
            EXPECT_EQ(refusal_of("SS115200", state, LinkKind::network, profile), Status("0F"));
            EXPECT_EQ(refusal_of("SS115200", state, LinkKind::tty, profile), Status("04"));
        }
    }
    // A model with a serial line decides for itself.
    const DeviceProfile serial = test_profile(Family::urg);
    EXPECT_EQ(refusal_of("SS115200", State::standby, LinkKind::tty, serial), std::nullopt);
}

TEST(Refusal, LooksAtTheStateBeforeTheParameters) {
    const DeviceProfile profile = test_profile();
    EXPECT_EQ(refusal_of("GD", State::standby, LinkKind::network, profile), status::denied);
    EXPECT_EQ(refusal_of("GD", State::measuring, LinkKind::network, profile), status::too_short);
    EXPECT_EQ(refusal_of("GD00020003012", State::measuring, LinkKind::network, profile),
              status::too_long);
}

TEST(Refusal, OfTheLaserWhereThereIsNone) {
    const DeviceProfile profile = test_profile();
    EXPECT_EQ(refusal_of("BM", State::standby, LinkKind::network, profile, Trouble::laser),
              Status("01"));
    EXPECT_EQ(refusal_of("BM", State::standby, LinkKind::network, profile), std::nullopt);
}

}  // namespace
}  // namespace scipd::protocol
