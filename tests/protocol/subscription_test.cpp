// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/subscription.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/protocol/test_profile.h"

namespace scipd::protocol {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

const DeviceProfile subscribed_profile = test_profile();

std::variant<Subscription, Status> parsed(const std::string& text, Uptime arrived = 0ms) {
    return Subscription::from(parse_request({text}, subscribed_profile), arrived,
                              subscribed_profile.scan_period, subscribed_profile);
}

Subscription subscription(const std::string& text, Uptime arrived = 0ms) {
    return std::get<Subscription>(parsed(text, arrived));
}

// Which of the first turns of 25 ms are taken.
std::vector<int> turns_taken(Subscription stream, Uptime laser_on_since) {
    std::vector<int> taken;
    for (int turn = 0; turn < 8; ++turn) {
        if (stream.takes({turn * 25ms}, laser_on_since)) taken.push_back(turn);
    }
    return taken;
}

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

TEST(Subscription, SaysWhatIsWrongFirst) {
    const auto fault = [](const std::string& text) { return std::get<Status>(parsed(text)); };
    EXPECT_EQ(fault("MDx00000090101x"), Status("01"));
    EXPECT_EQ(fault("MD0000000x01xxx"), Status("02"));
    EXPECT_EQ(fault("MD00000009x1xxx"), Status("03"));
    EXPECT_EQ(fault("MD0000001001xxx"), Status("04"));
    EXPECT_EQ(fault("MD0009000001xxx"), Status("05"));
    EXPECT_EQ(fault("MD0000000901xxx"), Status("06"));
    EXPECT_EQ(fault("MD00000009010x1"), Status("07"));
    EXPECT_EQ(fault("MD000000090101x"), Status("07"));
}

TEST(Subscription, TakesEveryTurnOrPassesOverSome) {
    const Uptime arrived = 30ms;  // within turn 1
    EXPECT_THAT(turns_taken(subscription("MD0000000901000", arrived), 0ms),
                ElementsAre(1, 2, 3, 4, 5, 6, 7));
    EXPECT_THAT(turns_taken(subscription("MD0000000901100", arrived), 0ms), ElementsAre(2, 4, 6));
    EXPECT_THAT(turns_taken(subscription("MD0000000901200", arrived), 0ms), ElementsAre(3, 6));
}

TEST(Subscription, ATurnThatBeginsWithTheRequestIsTheOneUnderWay) {
    EXPECT_THAT(turns_taken(subscription("MD0000000901100", 25ms), 0ms), ElementsAre(2, 4, 6));
    EXPECT_THAT(turns_taken(subscription("MD0000000901000", 25ms), 0ms),
                ElementsAre(1, 2, 3, 4, 5, 6, 7));
}

TEST(Subscription, TakesNoTurnThatBeganWithoutLaser) {
    const Uptime arrived = 30ms;
    EXPECT_THAT(turns_taken(subscription("MD0000000901000", arrived), 31ms),
                ElementsAre(2, 3, 4, 5, 6, 7));
    EXPECT_THAT(turns_taken(subscription("MD0000000901100", arrived), 31ms), ElementsAre(2, 4, 6));
    EXPECT_THAT(turns_taken(subscription("MD0000000901000", arrived), 50ms),
                ElementsAre(2, 3, 4, 5, 6, 7));
}

TEST(Subscription, CountsDownToZeroAndFinishes) {
    Subscription stream = subscription("MD0002000301012;ab c");
    const std::vector<std::uint32_t> scan = {1000, 1001};
    std::vector<std::string> echoes;
    while (!stream.finished())
        echoes.push_back(first_line(stream.message({{}, 2, scan, scan}, {}, subscribed_profile)));
    ASSERT_EQ(echoes.size(), 12U);
    EXPECT_EQ(echoes.front(), "MD0002000301011;ab c");
    EXPECT_EQ(echoes[1], "MD0002000301010;ab c");
    EXPECT_EQ(echoes[2], "MD0002000301009;ab c");
    EXPECT_EQ(echoes.back(), "MD0002000301000;ab c");
}

TEST(Subscription, AnEndlessOneNeverFinishes) {
    Subscription stream = subscription("MD0002000301000");
    const std::vector<std::uint32_t> scan = {1000, 1001};
    for (int i = 0; i < 150; ++i)
        ASSERT_EQ(first_line(stream.message({{}, 2, scan, scan}, {}, subscribed_profile)),
                  "MD0002000301000");
    EXPECT_FALSE(stream.finished());
}

TEST(Subscription, ItsMessageIsEchoStatusStampAndData) {
    Subscription stream = subscription("ME0002000301001");
    const std::vector<std::uint32_t> distance = {5432, 4};
    const std::vector<std::uint32_t> intensity = {1234, 262143};
    DeviceState device;
    device.reset(7ms);
    // 100 s after the clock was set to 0.
    EXPECT_EQ(stream.message({{100s + 7ms}, 2, distance, intensity}, device, subscribed_profile),
              "ME0002000301000\n99b\n0HJPB\n1Dh0CB004oooc\n\n");
}

}  // namespace
}  // namespace scipd::protocol
