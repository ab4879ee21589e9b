// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/client/scan_message.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <gmock/gmock.h>

#include "protocol/char_code.h"
#include "protocol/client/decoder.h"
#include "protocol/reply.h"

namespace scipd::protocol::client {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Message decoded(std::string_view bytes) {
    return Decoder().next(bytes).value();
}

ScanMessage scan_in(std::string_view bytes) {
    return std::get<ScanMessage>(parse_scan(decoded(bytes)));
}

std::string fault_in(std::string_view bytes) {
    return std::get<std::string>(parse_scan(decoded(bytes)));
}

/// A message with this data, sums and cuts made right.
std::string message_of(const std::string& echo, std::string_view data) {
    Reply reply(echo, status::scan_follows);
    reply.line("m2@0");
    for (; data.size() > 64; data.remove_prefix(64))
        reply.line(data.substr(0, 64));
    if (!data.empty()) reply.line(data);
    return reply.finish();
}

// 5432 is 1Dh and 1234 is CB in the specifications' examples.
TEST(ScanMessage, ReadsThreeCharacters) {
    const ScanMessage scan = scan_in(message_of("MD0000000201007", "1Dh004?om"));
    EXPECT_EQ(scan.stamp_ms, 16000000U);
    EXPECT_EQ(scan.status, "99");
    EXPECT_EQ(scan.request.scans, 7);
    EXPECT_THAT(scan.distances_mm, ElementsAre(5432, 4, 65533));
    EXPECT_THAT(scan.intensities, IsEmpty());
    EXPECT_THAT(scan.further_echoes, IsEmpty());
}

TEST(ScanMessage, ReadsTwoCharacters) {
    EXPECT_THAT(scan_in(message_of("MS0000000101000", "CBoo")).distances_mm,
                ElementsAre(1234, 4095));
}

// Recorded from a UTM-30LX: the first three steps of an ME.
TEST(ScanMessage, ReadsIntensities) {
    const ScanMessage scan = scan_in(message_of("ME0000000201100", "00]0LA00`0Kd00a0L0"));
    EXPECT_THAT(scan.distances_mm, ElementsAre(45, 48, 49));
    EXPECT_THAT(scan.intensities, ElementsAre(1809, 1780, 1792));
}

TEST(ScanMessage, ReadsEchoes) {
    const ScanMessage scan = scan_in(message_of("ND0000000201000", "0?X&0O@1Dh0?X&0O@&0_8"));
    EXPECT_THAT(scan.distances_mm, ElementsAre(1000, 5432, 1000));
    EXPECT_THAT(scan.further_echoes, ElementsAre(ElementsAre(Echo{2000, 0}), IsEmpty(),
                                                 ElementsAre(Echo{2000, 0}, Echo{3016, 0})));
}

TEST(ScanMessage, ReadsEchoesWithIntensity) {
    const ScanMessage scan = scan_in(message_of("NE0000000101000", "0?X0LA&0O@0Kd1Dh001"));
    EXPECT_THAT(scan.distances_mm, ElementsAre(1000, 5432));
    EXPECT_THAT(scan.intensities, ElementsAre(1809, 1));
    EXPECT_THAT(scan.further_echoes, ElementsAre(ElementsAre(Echo{2000, 1780}), IsEmpty()));
}

// The stamp: 10^12 in base 64.
TEST(ScanMessage, ReadsMicroseconds) {
    Reply reply("%MD0000000001000", status::scan_follows);
    const ScanMessage scan = scan_in(reply.line("0000>SDYA00").line("1Dh").finish());
    EXPECT_EQ(scan.stamp_us, 1'000'000'000'000U);
    EXPECT_THAT(scan.distances_mm, ElementsAre(5432));
}

TEST(ScanMessage, ReadsInputsAndOutputs) {
    Reply reply("GG0000000001", status::ok);
    const ScanMessage scan = scan_in(reply.line("0050oo").line("m2@0").line("1Dh00a").finish());
    EXPECT_EQ(scan.inputs, 5U);
    EXPECT_EQ(scan.outputs, 4095U);
    EXPECT_EQ(scan.stamp_ms, 16000000U);
    EXPECT_THAT(scan.distances_mm, ElementsAre(5432));
    EXPECT_THAT(scan.intensities, ElementsAre(49));
}

TEST(ScanMessage, RefusesAWrongStampOrNoInputsAndOutputs) {
    const auto message = [](const std::string& echo, std::string_view first) {
        return Reply(echo, status::ok).line(first).line("m2@0").line("1Dh").finish();
    };
    EXPECT_EQ(fault_in(message("GF0000000001", "00500")), "its inputs and outputs are missing");
    EXPECT_EQ(fault_in(message("GF0000000001", "00500~")), "its inputs and outputs are missing");
    EXPECT_EQ(fault_in(message("%MD0000000001000", "m2@0")), "its time stamp is none");
    EXPECT_EQ(fault_in(message("GD0000000001", "0000000m2@0")), "its time stamp is none");
    EXPECT_EQ(fault_in(Reply("GF0000000001", status::ok).line("005000").finish()),
              "it has no time stamp");
}

TEST(ScanMessage, JoinsLinesThatCutThroughValues) {
    // 64 characters are 21 values of three and a third.
    std::string data;
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < 50; ++i) {
        append_encoded(data, 4000 + 97 * i, 3);
        expected.push_back(4000 + 97 * i);
    }
    EXPECT_EQ(scan_in(message_of("MD0000004901000", data)).distances_mm, expected);
}

TEST(ScanMessage, TellsDamageAndRefusals) {
    EXPECT_EQ(fault_in("GD0000000001\n00P\nm2@0e\n1DiM\n\n"), "line 3 does not match its checksum");
    EXPECT_EQ(fault_in("GD0000000001\n10Q\n\n"),
              "status 10: not in the present state; BM switches the laser on, which a single scan "
              "needs");
    EXPECT_EQ(fault_in("GD0000990001\n04T\n\n"), "status 04: the scanner has no such step");
    EXPECT_EQ(fault_in("MD0000000001000\n52W\n\n"),
              "status 52: the laser or the motor is out of order");
    EXPECT_EQ(fault_in("QT\n00P\n\n"), "\"QT\" is no scan");
    EXPECT_EQ(fault_in("GD0000000001\n00P\n\n"), "it has no time stamp");
}

TEST(ScanMessage, RefusesAnotherNumberOfValuesThanItsEchoAnnounces) {
    EXPECT_EQ(fault_in(message_of("MD0000000201000", "1Dh004")), "it has 2 values instead of 3");
    EXPECT_EQ(fault_in(message_of("MD0000000001000", "1Dh004")), "it has 2 values instead of 1");
    EXPECT_EQ(fault_in(message_of("MD0000000101000", "1Dh00")),
              "its data ends within a value or holds what is none");
    EXPECT_EQ(fault_in(message_of("MD0000000101000", "1Dh&004")),
              "its data ends within a value or holds what is none");
    EXPECT_EQ(fault_in(message_of("ND0000000001000", "1Dh&")),
              "its data ends within a value or holds what is none");
}

TEST(ScanMessage, RefusesLinesThatAreNotCutAt64) {
    Reply reply("MD0000000101000", status::scan_follows);
    EXPECT_EQ(fault_in(reply.line("m2@0").line("1Dh").line("004").finish()),
              "its data is not cut into lines of 64 characters");
}

// What Session writes, client reads: through every length around the cuts, for all widths.
TEST(ScanMessage, IsTheInverseOfTheDataBlock) {
    for (const int width : {2, 3}) {
        const auto limit = static_cast<std::uint32_t>(max_encoded(width));
        for (int steps = 1; steps <= 200; ++steps) {
            std::vector<std::uint32_t> values;
            for (int i = 0; i < steps; ++i)
                values.push_back(static_cast<std::uint32_t>(i) * 2654435761U & limit);
            values.back() = limit;
            const ScanRequest request{.last_step = steps - 1, .width = width};
            const std::string bytes = Reply(stream_line(request), status::scan_follows)
                                          .line("0001")
                                          .data(values, width)
                                          .finish();
            const ScanMessage scan = scan_in(bytes);
            ASSERT_EQ(scan.distances_mm, values) << steps << " steps of " << width;
            ASSERT_EQ(scan.stamp_ms, 1U);
        }
    }
}

TEST(ScanMessage, IsTheInverseOfTheDataBlockWithIntensity) {
    for (int steps = 1; steps <= 100; ++steps) {
        std::vector<std::uint32_t> values;
        std::vector<std::uint32_t> distances;
        std::vector<std::uint32_t> intensities;
        for (int i = 0; i < steps; ++i) {
            distances.push_back(static_cast<std::uint32_t>(i) * 7919U % 262144U);
            intensities.push_back(262143U - distances.back());
            values.insert(values.end(), {distances.back(), intensities.back()});
        }
        const ScanRequest request{.last_step = steps - 1, .intensity = true};
        const ScanMessage scan = scan_in(Reply(stream_line(request), status::scan_follows)
                                             .line("0001")
                                             .data(values, 3)
                                             .finish());
        ASSERT_EQ(scan.distances_mm, distances);
        ASSERT_EQ(scan.intensities, intensities);
    }
}

}  // namespace
}  // namespace scipd::protocol::client
