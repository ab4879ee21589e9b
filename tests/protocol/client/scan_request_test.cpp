// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/client/scan_request.h"

#include <gtest/gtest.h>

#include "protocol/command_table.h"

namespace scipd::protocol::client {
namespace {

TEST(ScanRequest, IsSpeltAsTheSpecificationHasIt) {
    const ScanRequest whole{.first_step = 0, .last_step = 1080};
    EXPECT_EQ(single_scan_line(whole), "GD0000108001");
    EXPECT_EQ(stream_line(whole), "MD0000108001000");

    const ScanRequest narrow{
        .first_step = 44, .last_step = 725, .cluster = 3, .interval = 9, .scans = 42};
    EXPECT_EQ(stream_line(narrow), "MD0044072503942");
}

TEST(ScanRequest, HasACommandForEachKindOfData) {
    EXPECT_EQ(stream_line({.last_step = 9, .intensity = true}), "ME0000000901000");
    EXPECT_EQ(stream_line({.last_step = 9, .width = 2}), "MS0000000901000");
    EXPECT_EQ(stream_line({.last_step = 9, .echoes = true}), "ND0000000901000");
    EXPECT_EQ(stream_line({.last_step = 9, .intensity = true, .echoes = true}), "NE0000000901000");
    EXPECT_EQ(single_scan_line({.last_step = 9, .width = 2}), "GS0000000901");
    EXPECT_EQ(single_scan_line({.last_step = 9, .intensity = true}), "GE0000000901");
    EXPECT_EQ(single_scan_line({.last_step = 9, .echoes = true}), "HD0000000901");
    EXPECT_EQ(single_scan_line({.last_step = 9, .intensity = true, .echoes = true}),
              "HE0000000901");
    EXPECT_EQ(single_scan_line({.last_step = 9, .io_lines = true}), "GF0000000901");
    EXPECT_EQ(single_scan_line({.last_step = 9, .intensity = true, .io_lines = true}),
              "GG0000000901");
    EXPECT_EQ(stream_line({.last_step = 9, .io_lines = true}), "MF0000000901000");
    EXPECT_EQ(stream_line({.last_step = 9, .intensity = true, .io_lines = true}),
              "MG0000000901000");
    EXPECT_EQ(stream_line({.last_step = 9, .microseconds = true}), "%MD0000000901000");
    EXPECT_EQ(stream_line({.last_step = 9, .intensity = true, .microseconds = true}),
              "%ME0000000901000");
}

TEST(ScanRequest, IsReadBackFromItsEcho) {
    for (const bool intensity : {false, true}) {
        for (const bool echoes : {false, true}) {
            ScanRequest request{.first_step = 1,
                                .last_step = 2345,
                                .cluster = 12,
                                .intensity = intensity,
                                .echoes = echoes,
                                .interval = 3,
                                .scans = 45};
            EXPECT_EQ(parse_scan_echo(stream_line(request)), request);
            request.interval = request.scans = 0;
            EXPECT_EQ(parse_scan_echo(single_scan_line(request)), request);
        }
    }
    EXPECT_EQ(parse_scan_echo("MS0000000901000")->width, 2);
    for (const bool intensity : {false, true}) {
        const ScanRequest wires{.last_step = 9, .intensity = intensity, .io_lines = true};
        EXPECT_EQ(parse_scan_echo(single_scan_line(wires)), wires);
        EXPECT_EQ(parse_scan_echo(stream_line(wires)), wires);
        const ScanRequest precise{.last_step = 9, .intensity = intensity, .microseconds = true};
        EXPECT_EQ(parse_scan_echo(stream_line(precise)), precise);
    }
}

TEST(ScanRequest, KnowsEveryCommandForScansThatTheScannerKnows) {
    for (const Command& command : command_table()) {
        const std::string line =
            std::string(command.code) + "000100230" + (command.brings_scans() ? "2345" : "2");
        const auto request = parse_scan_echo(line);
        ASSERT_EQ(request.has_value(), command.brings_one_scan() || command.brings_scans()) << line;
        if (!request) continue;
        EXPECT_EQ(command.brings_scans() ? stream_line(*request) : single_scan_line(*request),
                  line);
    }
}

TEST(ScanRequest, OfAKindThatNoCommandBringsIsNone) {
    EXPECT_THROW((void)single_scan_line({.last_step = 9, .microseconds = true}),
                 std::invalid_argument);
    EXPECT_THROW((void)stream_line({.last_step = 9, .width = 2, .intensity = true}),
                 std::invalid_argument);
}

TEST(ScanRequest, TakesClusterZeroAsOneAndPassesOverAString) {
    EXPECT_EQ(parse_scan_echo("MD0000072500100")->cluster, 1);
    EXPECT_EQ(parse_scan_echo("MD0000108001000;left one")->last_step, 1080);
}

TEST(ScanRequest, KnowsTheCodesInThePlaceOfACluster) {
    const auto request = parse_scan_echo("MD00000009FF000");
    EXPECT_EQ(request->contents, Contents::distance_and_intensity);
    EXPECT_EQ(request->groups(), 10U);
    EXPECT_EQ(parse_scan_echo("GD00000009DC")->contents, Contents::gain);
    EXPECT_EQ(parse_scan_echo("GD00000009FA"), std::nullopt);
}

TEST(ScanRequest, IsNothingElse) {
    for (const char* const echo :
         {"", "QT", "MD000010800100", "GD00001080010", "XD0000108001", "HS0000108001",
          "NS0000108001000", "NF0000108001000", "%ND0000108001000", "%MF0000108001000",
          "%GD0000108001", "%%MD0000108001000", "GDx000108001", "GD0009000001"}) {
        EXPECT_EQ(parse_scan_echo(echo), std::nullopt) << echo;
    }
}

// A recorded UTM-30LX sends 271 values for its 1081 steps in fours.
TEST(ScanRequest, CountsAShorterLastGroup) {
    EXPECT_EQ((ScanRequest{.last_step = 1080, .cluster = 4}.groups()), 271U);
    EXPECT_EQ((ScanRequest{.last_step = 1079, .cluster = 4}.groups()), 270U);
    EXPECT_EQ((ScanRequest{.first_step = 7, .last_step = 7}.groups()), 1U);
}

}  // namespace
}  // namespace scipd::protocol::client
