// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/recording/wire_decoder.h"

#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>

#include "protocol/char_code.h"
#include "protocol/checksum.h"

namespace scipd::tests {
namespace {

using daemon::WireDecoder;
using sim::RecordedScan;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Optional;
using testing::SizeIs;

std::string summed(const std::string& text) {
    return text + protocol::checksum(text) + "\n";
}

std::string entry(const std::string& text) {
    return text + ";" + protocol::checksum(text) + "\n";
}

std::string number(std::uint32_t value, int width) {
    std::string text;
    protocol::append_encoded(text, value, width);
    return text;
}

/// The answers of a scanner of five steps, of which the third looks forward.
std::string parameters() {
    std::string text = "PP\n" + summed("00");
    for (const char* const line : {"MODL:UST-10LX(Maker)", "DMIN:20", "DMAX:30000", "ARES:4",
                                   "AMIN:0", "AMAX:4", "AFRT:2", "SCAN:2400"})
        text += entry(line);
    return text + "\n";
}

std::string scan(std::uint32_t stamp_ms, std::uint32_t range_mm) {
    std::string data;
    for (std::uint32_t step = 1; step <= 3; ++step)
        data += number(range_mm + step, 3);
    return "MD0001000301000\n" + summed("99") + summed(number(stamp_ms, 4)) + summed(data) + "\n";
}

std::vector<RecordedScan> decode(WireDecoder& decoder, std::string_view bytes,
                                 std::size_t piece = 1 << 20) {
    std::vector<RecordedScan> scans;
    for (std::int64_t time_s = 1; !bytes.empty(); ++time_s) {
        const std::string part(bytes.substr(0, piece));
        bytes.remove_prefix(part.size());
        for (auto& one : decoder.take({sim::Way::from_scanner, sim::host_time_at(time_s), part}))
            scans.push_back(std::move(one));
    }
    return scans;
}

TEST(WireDecoder, FindsScansAndWhoSendsThem) {
    WireDecoder decoder;
    const auto scans = decode(decoder, parameters() + scan(7, 1000) + scan(32, 2000));
    EXPECT_EQ(decoder.identity().model, "UST-10LX");
    EXPECT_THAT(decoder.identity().min_range_m, Optional(0.02));
    EXPECT_EQ(value_of(decoder.identity().parameters, "MODL"), "UST-10LX(Maker)");
    ASSERT_THAT(scans, SizeIs(2));
    EXPECT_THAT(scans[0].ranges, ElementsAre(1001, 1002, 1003));
    EXPECT_THAT(scans[1].stamp_ms, Optional(32U));
    EXPECT_THAT(scans[0].directions.first_step, Optional(1));
    EXPECT_THAT(scans[0].directions.first_rad, Optional(DoubleNear(-1.5707963, 1e-6)));
    EXPECT_EQ(decoder.damaged_scans(), 0U);
}

TEST(WireDecoder, DoesNotMindHowTheBytesAreCut) {
    const std::string bytes = parameters() + scan(7, 1000) + scan(32, 2000);
    for (std::size_t piece = 1; piece < 50; ++piece) {
        WireDecoder decoder;
        const auto scans = decode(decoder, bytes, piece);
        ASSERT_THAT(scans, SizeIs(2));
        // The time is that of the piece with the end of the scan.
        const auto pieces = static_cast<std::int64_t>((bytes.size() + piece - 1) / piece);
        EXPECT_EQ(scans[1].host_time, sim::host_time_at(pieces));
    }
}

TEST(WireDecoder, KnowsNoAnglesBeforeTheScannerHasTold) {
    WireDecoder decoder;
    const auto scans = decode(decoder, scan(7, 1000) + parameters() + scan(32, 2000));
    ASSERT_THAT(scans, SizeIs(2));
    EXPECT_FALSE(scans[0].directions.first_rad);
    EXPECT_TRUE(scans[1].directions.first_rad);
}

TEST(WireDecoder, CountsWhatIsDamagedAndGoesOn) {
    std::string bytes = scan(7, 1000) + scan(32, 2000) + scan(57, 3000);
    bytes.erase(bytes.size() / 2, 5);
    WireDecoder decoder;
    const auto scans = decode(decoder, bytes);
    ASSERT_THAT(scans, SizeIs(2));
    EXPECT_THAT(scans[1].stamp_ms, Optional(57U));
    EXPECT_EQ(decoder.damaged_scans(), 1U);
}

TEST(WireDecoder, FindsScansOfScip1) {
    WireDecoder decoder;
    const auto scans =
        decode(decoder,
               "V\n0\nVEND:Maker\nFIRM:3.0\nSERI:H7\n\nG04404702\n0\n0D?X\n\nG04404702\nE\n\n", 3);
    ASSERT_THAT(scans, SizeIs(1));
    EXPECT_THAT(scans[0].ranges, ElementsAre(20, 1000));
    EXPECT_FALSE(scans[0].stamp_ms);
    EXPECT_THAT(scans[0].directions.first_step, Optional(44));
    EXPECT_EQ(scans[0].directions.cluster, 2);
    EXPECT_EQ(decoder.identity().serial, "H7");
    EXPECT_EQ(decoder.identity().firmware, "3.0");
}

TEST(WireDecoder, TellsOtherConversationsApart) {
    WireDecoder decoder;
    EXPECT_THAT(decode(decoder, "HTTP/1.1 200 OK\r\n\r\nhello\n\nworld\n\n"), IsEmpty());
    EXPECT_EQ(decoder.sound_messages(), 0U);
}

TEST(WireDecoder, HearsTheScannerAlone) {
    WireDecoder decoder;
    EXPECT_THAT(decoder.take({sim::Way::to_scanner, {}, scan(7, 1000)}), IsEmpty());
    EXPECT_EQ(decoder.sound_messages(), 0U);
}

}  // namespace
}  // namespace scipd::tests
