// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/stream_check.h"

#include <string>

#include <gtest/gtest.h>

namespace scipd::tools {
namespace {

using namespace std::chrono_literals;

// Sums and stamps as the specification has them, without any code of scipd.
std::string with_sum(const std::string& text) {
    int sum = 0;
    for (const char c : text)
        sum += c;
    std::string line = text;
    line.append({char((sum & 63) + 48), '\n'});
    return line;
}

std::string stamp(unsigned ms) {
    std::string text;
    for (const int shift : {18, 12, 6, 0})
        text += char(((ms >> shift) & 63) + 48);
    return text;
}

const std::string answer = "MD0000010001000\n00P\n\n";

/// 101 steps: 303 characters, in five lines.
std::string scan(unsigned stamp_ms) {
    std::string message = "MD0000010001000\n" + with_sum("99") + with_sum(stamp(stamp_ms));
    std::string data;
    for (int i = 0; i < 101; ++i)
        data.append({'0', char('0' + i % 64), 'o'});
    for (std::size_t i = 0; i < data.size(); i += 64)
        message += with_sum(data.substr(i, 64));
    return message + "\n";
}

StreamCheck check() {
    return StreamCheck({.first_step = 0, .last_step = 100}, 25ms);
}

StreamFindings look_at(const std::string& stream, std::size_t piece = 1000) {
    StreamCheck made = check();
    for (std::size_t i = 0; i < stream.size(); i += piece)
        made.take(std::string_view(stream).substr(i, piece), {});
    return made.findings();
}

TEST(StreamCheck, FindsNothingInAWholeStreamHoweverItIsCut) {
    std::string stream = answer;
    for (unsigned i = 0; i < 50; ++i)
        stream += scan(1000 + i * 2505 / 100);  // turns of 25.05 ms
    for (const std::size_t piece : {1UL, 7UL, 400UL, 100'000UL}) {
        const StreamFindings found = look_at(stream, piece);
        EXPECT_TRUE(found.sound()) << piece;
        EXPECT_EQ(found.scans, 50U);
        EXPECT_EQ(found.bytes, stream.size());
    }
}

TEST(StreamCheck, FindsAWrongByteAnywhereInAScan) {
    const std::string good = scan(1025);
    for (std::size_t i = 0; i < good.size(); ++i) {
        std::string bad = good;
        bad[i] = bad[i] == '5' ? '6' : '5';
        const bool in_the_count = i == 13 || i == 14;  // tells how many scans are still to come
        if (in_the_count) continue;
        const StreamFindings found = look_at(answer + scan(1000) + bad + scan(1050));
        EXPECT_FALSE(found.sound()) << i;
        EXPECT_GE(found.damaged, 1U) << i;
    }
}

TEST(StreamCheck, FindsWhatIsMissingRepeatedOrOutOfOrder) {
    EXPECT_EQ(look_at(answer + scan(0) + scan(25) + scan(100) + scan(125)).missing, 2U);
    EXPECT_EQ(look_at(answer + scan(0) + scan(25) + scan(25)).disordered, 1U);
    EXPECT_EQ(look_at(answer + scan(100) + scan(50)).disordered, 1U);
    EXPECT_EQ(look_at(answer + scan(0) + scan(12)).disordered, 1U);
    EXPECT_FALSE(look_at(answer).sound());
}

TEST(StreamCheck, GoesOnWhereStampsWrap) {
    const StreamFindings found = look_at(answer + scan((1U << 24U) - 20) + scan(5) + scan(30));
    EXPECT_TRUE(found.sound());
    EXPECT_EQ(found.scans, 3U);
}

TEST(StreamCheck, TellsHowMuchLaterThanTheSoonestScansCame) {
    StreamCheck made = check();
    const StreamCheck::Time begin{};
    made.take(answer + scan(1000), begin + 7ms);
    made.take(scan(1025), begin + 27ms);
    made.take(scan(1050), begin + 62ms);
    EXPECT_EQ(made.delays_ms(), (std::vector<double>{5, 0, 10}));
}

}  // namespace
}  // namespace scipd::tools
