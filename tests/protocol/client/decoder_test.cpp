// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/client/decoder.h"

#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>

namespace scipd::protocol::client {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// The PP reply of a recorded UTM-30LX.
constexpr std::string_view parameters =
    "PP\n00P\nMODL:UTM-30LX(Hokuyo Automatic Co.,Ltd.);U\nDMIN:23;7\nDMAX:60000;J\nARES:1440;^\n"
    "AMIN:0;?\nAMAX:1080;Z\nAFRT:540;0\nSCAN:2400;U\n\n";

std::vector<Message> decode_all(std::string_view bytes) {
    Decoder decoder;
    std::vector<Message> messages;
    while (auto message = decoder.next(bytes))
        messages.push_back(*message);
    return messages;
}

Damage damage_of(std::string_view bytes) {
    const auto messages = decode_all(bytes);
    if (messages.size() != 1) throw std::logic_error("that was not one message");
    return messages.front().damage.value();
}

void expect_parameters(const Message& message) {
    EXPECT_EQ(message.echo, "PP");
    EXPECT_EQ(message.status, "00");
    EXPECT_THAT(message.lines,
                ElementsAre("MODL:UTM-30LX(Hokuyo Automatic Co.,Ltd.)", "DMIN:23", "DMAX:60000",
                            "ARES:1440", "AMIN:0", "AMAX:1080", "AFRT:540", "SCAN:2400"));
    EXPECT_EQ(message.damage, std::nullopt);
}

TEST(Decoder, TakesAMessageApart) {
    const auto messages = decode_all(parameters);
    ASSERT_EQ(messages.size(), 1U);
    expect_parameters(messages.front());
}

TEST(Decoder, TakesAMessageInTwoPiecesCutAnywhere) {
    for (std::size_t cut = 0; cut <= parameters.size(); ++cut) {
        Decoder decoder;
        std::string_view first = parameters.substr(0, cut);
        std::string_view second = parameters.substr(cut);
        auto message = decoder.next(first);
        EXPECT_TRUE(first.empty());
        EXPECT_EQ(message.has_value(), cut == parameters.size());
        if (!message) message = decoder.next(second);
        ASSERT_TRUE(message) << "cut at " << cut;
        expect_parameters(*message);
    }
}

TEST(Decoder, TakesAMessageByteByByte) {
    Decoder decoder;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        std::string_view byte = parameters.substr(i, 1);
        const auto message = decoder.next(byte);
        ASSERT_EQ(message.has_value(), i + 1 == parameters.size());
        if (message) expect_parameters(*message);
    }
}

TEST(Decoder, TakesMessagesThatComeTogetherAndPassesOverEmptyLinesBetween) {
    const auto messages = decode_all("\nBM\n00P\n\n\n\nTM1\n00P\n<SfkP\n\n");
    ASSERT_EQ(messages.size(), 2U);
    EXPECT_EQ(messages[0].echo, "BM");
    EXPECT_THAT(messages[0].lines, IsEmpty());
    EXPECT_EQ(messages[1].echo, "TM1");
    EXPECT_THAT(messages[1].lines, ElementsAre("<Sfk"));
}

// UST-10LX: the time is spelt in characters that may be a semicolon.
TEST(Decoder, TakesASemicolonInAValue) {
    const auto messages = decode_all("II\n00P\nTIME:j;o[;H\n\n");
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_EQ(messages[0].damage, std::nullopt);
    EXPECT_THAT(messages[0].lines, ElementsAre("TIME:j;o["));
}

TEST(Decoder, NoticesEveryChangedCharacterOfAReply) {
    const std::size_t after_echo = std::string_view("PP\n").size();
    for (std::size_t i = after_echo; i < parameters.size(); ++i) {
        if (parameters[i] == '\n') continue;
        std::string damaged(parameters);
        damaged[i] = static_cast<char>(damaged[i] ^ 1);
        EXPECT_TRUE(damage_of(damaged).line >= 2) << "at " << i;
    }
}

TEST(Decoder, TellsWhichLineIsDamaged) {
    using Kind = Damage::Kind;
    EXPECT_EQ(damage_of("PP\n00Q\n\n"), (Damage{Kind::bad_status, 2}));
    EXPECT_EQ(damage_of("PP\n0000P\n\n"), (Damage{Kind::bad_status, 2}));
    EXPECT_EQ(damage_of("PP\n\n"), (Damage{Kind::no_status, 2}));
    EXPECT_EQ(damage_of("PP\n00P\nDMIN:23;7\nDMAX:60000;K\n\n"), (Damage{Kind::bad_sum, 4}));
    EXPECT_EQ(damage_of("PP\n00P\nDMIN:237\n\n"), (Damage{Kind::bad_sum, 3}));
    EXPECT_EQ(damage_of("TM1\n00P\n<SfkQ\n\n"), (Damage{Kind::bad_sum, 3}));
    EXPECT_EQ(damage_of("TM1\r\n00P\r\n\n"), (Damage{Kind::bad_status, 2}));
}

TEST(Decoder, GoesOnAfterADamagedMessage) {
    const auto messages = decode_all("BM\n00Q\n\nQT\n00P\n\n");
    ASSERT_EQ(messages.size(), 2U);
    EXPECT_TRUE(messages[0].damage);
    EXPECT_EQ(messages[1].echo, "QT");
    EXPECT_FALSE(messages[1].damage);
}

// Recorded from a URG-04LX at power-up: one character of status, no sums.
TEST(Decoder, TakesScip11) {
    const auto messages = decode_all("QT\nE\n\nSCIP2.0\n0\n\nV\n0\nPROT:00003,(SCIP 1.0)\n\n");
    ASSERT_EQ(messages.size(), 3U);
    EXPECT_EQ(messages[0].status, "E");
    EXPECT_EQ(messages[1].status, "0");
    EXPECT_THAT(messages[2].lines, ElementsAre("PROT:00003,(SCIP 1.0)"));
    for (const Message& message : messages)
        EXPECT_FALSE(message.damage);
}

TEST(Decoder, KeepsNoMoreThanALineOfAnEndlessOne) {
    const std::string endless(10 * Decoder::max_line, 'x');
    const auto messages = decode_all(endless + "\n00P\n\n");
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_EQ(messages[0].echo.size(), Decoder::max_line);
    EXPECT_EQ(messages[0].damage, (Damage{Damage::Kind::line_too_long, 1}));
}

TEST(Decoder, KeepsNoMoreThanAMessageOfAnEndlessOne) {
    const std::string line = "<SfkP\n";
    std::string endless = "TM1\n00P\n";
    while (endless.size() < 3 * Decoder::max_message)
        endless += line;
    const auto messages = decode_all(endless + "\nQT\n00P\n\n");
    ASSERT_EQ(messages.size(), 2U);
    EXPECT_EQ(messages[0].damage->kind, Damage::Kind::too_long);
    EXPECT_LE(messages[0].lines.size() * (line.size() - 1), Decoder::max_message);
    EXPECT_FALSE(messages[1].damage);
}

}  // namespace
}  // namespace scipd::protocol::client
