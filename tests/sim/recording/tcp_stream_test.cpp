// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/pcap/tcp_stream.h"

#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "sim/recording/pcap/tcp_segment.h"

namespace scipd::tests {
namespace {

using sim::HostTime;
using sim::TcpStream;

std::string joined(const std::vector<TcpStream::Piece>& pieces) {
    std::string bytes;
    for (const auto& piece : pieces)
        bytes += piece.bytes;
    return bytes;
}

TEST(TcpStream, PutsSegmentsInOrder) {
    TcpStream stream;
    stream.open(99);
    EXPECT_EQ(joined(stream.add(103, HostTime{}, "def")), "");
    EXPECT_EQ(joined(stream.add(100, HostTime{}, "abc")), "abcdef");
    EXPECT_EQ(stream.lost(), 0U);
}

TEST(TcpStream, CountsWhatComesTwiceOnce) {
    TcpStream stream;
    stream.open(99);
    EXPECT_EQ(joined(stream.add(100, HostTime{}, "abc")), "abc");
    EXPECT_EQ(joined(stream.add(100, HostTime{}, "abc")), "");
    EXPECT_EQ(joined(stream.add(101, HostTime{}, "bcdef")), "def");
    EXPECT_EQ(joined(stream.add(110, HostTime{}, "k")), "");
    EXPECT_EQ(joined(stream.add(108, HostTime{}, "ij")), "");
    EXPECT_EQ(joined(stream.add(108, HostTime{}, "ijk")), "");
    EXPECT_EQ(joined(stream.add(106, HostTime{}, "gh")), "ghijk");
}

TEST(TcpStream, WrapsItsNumbers) {
    TcpStream stream;
    stream.open(0xFFFFFFFD);
    EXPECT_EQ(joined(stream.add(0xFFFFFFFE, HostTime{}, "abcd")), "abcd");
    EXPECT_EQ(joined(stream.add(2, HostTime{}, "ef")), "ef");
}

TEST(TcpStream, BeginsInTheMiddle) {
    TcpStream stream;
    EXPECT_EQ(joined(stream.add(5000, HostTime{}, "abc")), "abc");
    EXPECT_EQ(joined(stream.add(5003, HostTime{}, "d")), "d");
}

TEST(TcpStream, SkipsWhatIsLostAtTheEnd) {
    TcpStream stream;
    stream.open(99);
    EXPECT_EQ(joined(stream.add(110, HostTime{}, "k")), "");
    EXPECT_EQ(joined(stream.finish()), "k");
    EXPECT_EQ(stream.lost(), 10U);
}

TEST(TcpStream, DoesNotWaitForEver) {
    TcpStream stream;
    stream.open(99);
    std::uint32_t sequence = 101;
    std::string got;
    for (int i = 0; i < 1000; ++i, sequence += 1000)
        got += joined(stream.add(sequence, HostTime{}, std::string(1000, 'x')));
    EXPECT_GT(got.size(), 700'000U);
    EXPECT_EQ(stream.lost(), 1U);
}

TEST(TcpStream, GivesEachPieceTheTimeOfItsSegment) {
    TcpStream stream;
    stream.open(99);
    const HostTime early{std::chrono::seconds(1)};
    const HostTime late{std::chrono::seconds(2)};
    (void)stream.add(103, early, "def");
    const auto pieces = stream.add(100, late, "abc");
    ASSERT_EQ(pieces.size(), 2U);
    EXPECT_EQ(pieces[0].time, late);
    EXPECT_EQ(pieces[1].time, early);
}

/// An Ethernet frame with an IPv4 packet from 10.0.0.1:10940 to 10.0.0.2:50000.
std::string frame(const std::string& payload) {
    const auto length = static_cast<char>(40 + payload.size());
    std::string bytes = std::string(12, 'm') + std::string("\x08\x00", 2);
    bytes +=
        std::string("\x45\x00\x00", 3) + length + std::string("\x00\x01\x40\x00\x40\x06\0\0", 8);
    bytes += std::string("\x0A\0\0\x01\x0A\0\0\x02", 8);
    bytes += std::string("\x2A\xBC\xC3\x50\0\0\0\x07\0\0\0\0\x50\x18\0\0\0\0\0\0", 20) + payload;
    return bytes;
}

TEST(TcpSegment, IsFoundInAFrame) {
    const std::string bytes = frame("hello") + std::string(20, '\0');  // padded
    const auto segment = sim::tcp_segment(1, bytes);
    ASSERT_TRUE(segment);
    EXPECT_EQ(text_of(segment->from), "10.0.0.1:10940");
    EXPECT_EQ(text_of(segment->to), "10.0.0.2:50000");
    EXPECT_EQ(segment->sequence, 7U);
    EXPECT_EQ(segment->payload, "hello");
    EXPECT_FALSE(segment->syn);
}

TEST(TcpSegment, IsFoundBehindATag) {
    std::string bytes = frame("hello");
    bytes.insert(12, std::string("\x81\x00\x00\x05", 4));
    ASSERT_TRUE(sim::tcp_segment(1, bytes));
    EXPECT_EQ(sim::tcp_segment(1, bytes)->payload, "hello");
}

TEST(TcpSegment, IsNoneOfAPacketThatIsCut) {
    const std::string whole = frame("hello");
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const auto segment = sim::tcp_segment(1, std::string_view(whole).substr(0, size));
        EXPECT_TRUE(!segment || segment->payload.size() < 5);
    }
}

}  // namespace
}  // namespace scipd::tests
