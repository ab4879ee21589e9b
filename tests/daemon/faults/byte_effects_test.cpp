// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/checksum.h"
#include "tests/daemon/faults/fake_scene.h"

namespace scipd::daemon {
namespace {

using protocol::Send;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Offsets = std::vector<std::size_t>;

std::string text(std::size_t size) {
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i)
        bytes += static_cast<char>('0' + i % 64);
    return bytes;
}

/// A scan with two lines of data, by the rules of SCIP 2.0.
std::string scan_message() {
    const auto line = [](const std::string& characters) {
        return characters + protocol::checksum(characters) + "\n";
    };
    return "MD0000001001000\n" + line("99") + line("0Ab1") + line(text(64)) + line("abcdef") + "\n";
}

std::string after(FaultEffect& effect, FakeScene& scene, const std::string& bytes,
                  Send::Kind kind = Send::Kind::reply) {
    Send message{bytes, kind};
    effect.bytes(message, scene);
    scene.go_on();
    return message.bytes;
}

Offsets differences(const std::string& a, const std::string& b) {
    EXPECT_EQ(a.size(), b.size());
    Offsets offsets;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        if (a[i] != b[i]) offsets.push_back(i);
    }
    return offsets;
}

TEST(ByteEffects, CorruptsOneBitOfWhatItReportsAndNothingElse) {
    const auto corrupt = effect_of("corrupt", "{bytes: {rate: 0.2}}");
    FakeScene scene;
    for (int i = 0; i < 100; ++i) {
        const std::string sent = text(100);
        const std::string got = after(*corrupt, scene, sent);
        const Offsets offsets = differences(sent, got);
        if (offsets.empty()) continue;
        EXPECT_EQ(scene.touches.back().bytes, offsets);
        for (const std::size_t offset : offsets) {
            EXPECT_EQ(std::popcount(static_cast<unsigned char>(sent[offset] ^ got[offset])), 1);
        }
    }
}

TEST(ByteEffects, RepeatARun) {
    for (const std::string kind : {"corrupt", "lose", "duplicate"}) {
        const auto run = [&](std::uint64_t seed) {
            FakeScene scene(seed);
            const auto effect = effect_of(kind, "{bytes: {rate: 0.1}}");
            std::string all;
            for (int i = 0; i < 20; ++i)
                all += after(*effect, scene, text(200)) + "|";
            return all;
        };
        EXPECT_EQ(run(7), run(7)) << kind;
        EXPECT_NE(run(7), run(8)) << kind;
    }
}

TEST(ByteEffects, HitAsManyBytesAsTheirRate) {
    constexpr double messages = 200;
    constexpr std::size_t size = 1000;
    for (const double rate : {0.0, 0.001, 0.03, 0.5, 1.0}) {
        const std::string members = "{bytes: {rate: " + std::to_string(rate) + "}}";
        const auto corrupt = effect_of("corrupt", members);
        const auto lose = effect_of("lose", members);
        const auto duplicate = effect_of("duplicate", members);
        FakeScene scene;
        double hit = 0;
        double lost = 0;
        double twice = 0;
        for (int i = 0; i < messages; ++i) {
            const std::string sent = text(size);
            hit += static_cast<double>(differences(sent, after(*corrupt, scene, sent)).size());
            lost += static_cast<double>(size - after(*lose, scene, sent).size());
            twice += static_cast<double>(after(*duplicate, scene, sent).size() - size);
        }
        const double bytes = messages * size;
        const double five_sigma = 5.0 * std::sqrt(bytes * rate * (1.0 - rate));
        EXPECT_NEAR(hit, rate * bytes, five_sigma);
        EXPECT_NEAR(lost, rate * bytes, five_sigma);
        EXPECT_NEAR(twice, rate * bytes, five_sigma);
    }
}

// Each bit as often as the others: 8 shares of a binomial distribution.
TEST(ByteEffects, CorruptAnyBit) {
    const auto corrupt = effect_of("corrupt", "{bytes: {rate: 1}}");
    FakeScene scene;
    std::vector<double> hits(8);
    for (int i = 0; i < 100; ++i) {
        for (const char c : after(*corrupt, scene, std::string(1000, '\0')))
            ++hits.at(static_cast<std::size_t>(std::countr_zero(static_cast<unsigned char>(c))));
    }
    const double five_sigma = 5.0 * std::sqrt(1e5 / 8.0 * 7.0 / 8.0);
    for (const double hit : hits)
        EXPECT_NEAR(hit, 1e5 / 8.0, five_sigma);
}

TEST(ByteEffects, HitTheOffsetsThatAreAskedFor) {
    FakeScene scene;
    const auto lose = effect_of("lose", "{bytes: {at: [4, 0, 9]}}");
    EXPECT_EQ(after(*lose, scene, "abcdef"), "bcdf");
    EXPECT_THAT(scene.touches.back().bytes, ElementsAre(0, 4));
    const auto duplicate = effect_of("duplicate", "{bytes: {at: [1, 5]}}");
    EXPECT_EQ(after(*duplicate, scene, "abcdef"), "abbcdeff");
    EXPECT_THAT(scene.touches.back().bytes, ElementsAre(1, 5));
    const auto corrupt = effect_of("corrupt", "{bytes: {at: [2]}}");
    EXPECT_THAT(differences("abcdef", after(*corrupt, scene, "abcdef")), ElementsAre(2));
    EXPECT_EQ(scene.touches.back().what, "1 byte changed");
    EXPECT_EQ(after(*corrupt, scene, "ab"), "ab");
    EXPECT_EQ(scene.touches.size(), 3U);
}

TEST(ByteEffects, SpareOtherMessages) {
    FakeScene scene;
    const auto scans = effect_of("lose", "{bytes: {at: [0]}, messages: scans}");
    EXPECT_EQ(after(*scans, scene, "abc", Send::Kind::reply), "abc");
    EXPECT_EQ(after(*scans, scene, "abc", Send::Kind::scan), "bc");
    const auto replies = effect_of("lose", "{bytes: {at: [0]}, messages: replies}");
    EXPECT_EQ(after(*replies, scene, "abc", Send::Kind::reply), "bc");
    EXPECT_EQ(after(*replies, scene, "abc", Send::Kind::scan), "abc");
    EXPECT_EQ(scene.touches.size(), 2U);
}

TEST(ByteEffects, CorruptSumsAlone) {
    const auto corrupt = effect_of("corrupt", "{bytes: {rate: 1}, within: sums}");
    FakeScene scene;
    const std::string sent = scan_message();
    Offsets ends;  // of the lines behind the echo
    for (std::size_t at = sent.find('\n') + 1; at < sent.size(); ++at) {
        if (sent[at] == '\n' && sent[at - 1] != '\n') ends.push_back(at - 1);
    }
    ASSERT_EQ(ends.size(), 4U);
    EXPECT_EQ(differences(sent, after(*corrupt, scene, sent)), ends);
    EXPECT_EQ(scene.touches.back().bytes, ends);
    // SCIP 1.1 has none.
    const std::string scip1 = "G00010100\n0\n0A0B0C\n\n";
    EXPECT_EQ(after(*corrupt, scene, scip1), scip1);
    EXPECT_EQ(after(*corrupt, scene, "no line"), "no line");
}

TEST(ByteEffects, SayWhatIsWrongWithTheirMembers) {
    EXPECT_THAT(refusal("corrupt", "{}"), HasSubstr("needs either bytes: {rate"));
    EXPECT_THAT(refusal("lose", "{bytes: {rate: 1, at: [1]}}"), HasSubstr("needs either bytes"));
    EXPECT_THAT(refusal("lose", "{bytes: {at: [-1]}}"), HasSubstr("must be a whole number from"));
    EXPECT_THAT(refusal("lose", "{bytes: {rate: 2}}"), HasSubstr("'2'"));
    EXPECT_THAT(refusal("lose", "{bytes: {rate: 1}, within: sums}"), HasSubstr("within"));
    EXPECT_THAT(refusal("corrupt", "{bytes: {rate: 1}, within: lines}"),
                HasSubstr("must be one of all, sums, not 'lines'"));
    EXPECT_THAT(refusal("corrupt", "{bytes: {rate: 1}, messages: some}"),
                HasSubstr("must be one of all, scans, replies, not 'some'"));
    EXPECT_THAT(refusal("noise", "{count: 0}"), HasSubstr("from 1 to 4096"));
    EXPECT_THAT(refusal("noise", "{value: white}"), HasSubstr("must be one of nul, random"));
}

}  // namespace
}  // namespace scipd::daemon
