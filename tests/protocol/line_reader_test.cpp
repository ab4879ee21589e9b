// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/line_reader.h"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scipd::protocol {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> lines_of(std::string_view bytes, std::size_t piece,
                                  LineReader reader = LineReader{}) {
    std::vector<std::string> lines;
    while (!bytes.empty()) {
        std::string_view part = bytes.substr(0, piece);
        bytes.remove_prefix(part.size());
        while (auto line = reader.next(part))
            lines.push_back((line->overlong ? "overlong " : "") + line->text);
        EXPECT_TRUE(part.empty()) << "bytes were left behind";
    }
    return lines;
}

TEST(LineReader, EndsALineAtEitherTerminator) {
    EXPECT_THAT(lines_of("VV\nPP\rII\r\nBM", 100), ElementsAre("VV", "PP", "II"));
}

TEST(LineReader, PassesOverEmptyLines) {
    EXPECT_THAT(lines_of("\n\r\r\n\n", 100), IsEmpty());
    EXPECT_THAT(lines_of("\nVV\n\n\r\nPP\n", 100), ElementsAre("VV", "PP"));
}

TEST(LineReader, DoesNotCareHowTheBytesCome) {
    const std::string bytes =
        "\nQT\nTM1;ab cd\r\n\r" + std::string(200, 'x') + "\nGD0000108001\nMD";
    const auto whole = lines_of(bytes, bytes.size());
    EXPECT_THAT(
        whole, ElementsAre("QT", "TM1;ab cd", "overlong " + std::string(128, 'x'), "GD0000108001"));
    for (std::size_t piece = 1; piece < bytes.size(); ++piece)
        EXPECT_EQ(lines_of(bytes, piece), whole) << "in pieces of " << piece;
}

TEST(LineReader, CutsAtItsLimitAndNotBefore) {
    const std::string longest(LineReader::max_length, 'x');
    EXPECT_THAT(lines_of(longest + "\n", 7), ElementsAre(longest));
    EXPECT_THAT(lines_of(longest + "y\nVV\n", 7), ElementsAre("overlong " + longest, "VV"));
}

TEST(LineReader, TakesAnotherLimitAndKeepsIt) {
    EXPECT_THAT(lines_of("12345\n123456\n12345\n", 2, LineReader(5)),
                ElementsAre("12345", "overlong 12345", "12345"));
}

TEST(LineReader, KeepsAnyOtherByte) {
    const std::string odd("\x01\0;\xff", 4);
    EXPECT_THAT(lines_of(odd + "\n", 1), ElementsAre(odd));
}

TEST(LineReader, PassesOverNulWhereALineWouldBegin) {
    using namespace std::string_literals;
    const std::string bytes = "\0BM\n\0GD0000108001\n\0\0\r\n\0QT\n\0"s;
    for (std::size_t piece = 1; piece <= bytes.size(); ++piece)
        EXPECT_THAT(lines_of(bytes, piece), ElementsAre("BM", "GD0000108001", "QT")) << piece;
    EXPECT_THAT(lines_of(std::string(200, '\0') + "VV\n", 7), ElementsAre("VV"));
}

}  // namespace
}  // namespace scipd::protocol
