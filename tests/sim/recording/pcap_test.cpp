// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/pcap/pcap.h"

#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

namespace scipd::tests {
namespace {

using namespace std::string_literals;
using sim::HostTime;
using sim::RecordedBytes;
using sim::Way;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int ethernet = 1;
constexpr std::uint8_t syn = 0x02;
constexpr std::uint8_t ack = 0x10;

std::string big(std::uint64_t value, int bytes) {
    std::string text;
    while (bytes-- > 0)
        text += static_cast<char>(value >> 8 * bytes & 0xFF);
    return text;
}

struct Port {
    std::string address;
    int number;
};
const Port scanner{"\x0A\0\0\x01"s, 10940};
const Port client{"\x0A\0\0\x02"s, 50000};

std::string tcp(const Port& from, const Port& to, std::uint32_t sequence,
                const std::string& payload, std::uint8_t flags = ack) {
    return big(from.number, 2) + big(to.number, 2) + big(sequence, 4) + big(0, 4) + "\x50" +
           big(flags, 1) + big(0, 6) + payload;
}

/// A packet of IPv4; `fragment` are its flags and its offset, in units of eight bytes.
std::string ipv4(const Port& from, const Port& to, const std::string& content, int fragment = 0) {
    return "\x45\0"s + big(20 + content.size(), 2) + big(7, 2) + big(fragment, 2) + "\x40\x06" +
           big(0, 2) + from.address + to.address + content;
}

std::string ipv6(const Port& from, const Port& to, const std::string& content) {
    return big(0x60000000, 4) + big(content.size(), 2) + "\x06\x40" + from.address + to.address +
           content;
}

std::string framed(const std::string& packet) {
    const std::string frame = std::string(12, 'm') + "\x08\0"s + packet;
    return frame + std::string(frame.size() < 60 ? 60 - frame.size() : 0, '\0');
}

/// A capture, in the format whose times have nanoseconds: packet `i` came at second `i`.
class Capture {
  public:
    explicit Capture(int link = ethernet) {
        bytes_ =
            big(0xA1B23C4D, 4) + big(2, 2) + big(4, 2) + big(0, 8) + big(0x40000, 4) + big(link, 4);
    }

    Capture& add(const std::string& frame) {
        bytes_ += big(count_++, 4) + big(123'456'789, 4) + big(frame.size(), 4);
        bytes_ += big(frame.size(), 4) + frame;
        return *this;
    }
    Capture& segment(std::uint32_t sequence, const std::string& payload, std::uint8_t flags = ack) {
        return add(framed(ipv4(scanner, client, tcp(scanner, client, sequence, payload, flags))));
    }
    Capture& asked(std::uint32_t sequence, const std::string& payload, std::uint8_t flags = ack) {
        return add(framed(ipv4(client, scanner, tcp(client, scanner, sequence, payload, flags))));
    }

    [[nodiscard]] std::unique_ptr<sim::Recording> opened() const {
        auto opened = sim::open_pcap(sim::InputFile::of_bytes("a.pcap", bytes_));
        EXPECT_TRUE(opened) << opened.error().why;
        return std::move(*opened);
    }
    [[nodiscard]] std::vector<RecordedBytes> pieces() const { return pieces_of(*opened()); }
    static std::vector<RecordedBytes> pieces_of(sim::Recording& recording) {
        std::vector<RecordedBytes> pieces;
        while (auto item = recording.next().value())
            pieces.push_back(std::get<RecordedBytes>(item->what));
        return pieces;
    }
    [[nodiscard]] std::string text() const {
        std::string text;
        for (const RecordedBytes& piece : pieces())
            text += piece.bytes;
        return text;
    }

  private:
    std::string bytes_;
    std::uint32_t count_ = 0;
};

HostTime at(int seconds) {
    return HostTime(std::chrono::seconds(seconds) + std::chrono::nanoseconds(123'456'789));
}

TEST(Pcap, TellsWaysAndTimesToTheNanosecond) {
    const Capture capture = std::move(Capture{}
                                          .asked(99, "", syn)
                                          .segment(499, "", syn | ack)
                                          .asked(100, "VV\n")
                                          .segment(500, "VV\n00P\n\n"));
    const auto recording = capture.opened();
    EXPECT_THAT(Capture::pieces_of(*recording),
                ElementsAre(RecordedBytes{Way::to_scanner, at(2), "VV\n"},
                            RecordedBytes{Way::from_scanner, at(3), "VV\n00P\n\n"}));
    ASSERT_EQ(recording->streams().size(), 1U);
    EXPECT_EQ(recording->streams()[0].name, "10.0.0.1:10940 with 10.0.0.2:50000");
    EXPECT_THAT(recording->warnings(), IsEmpty());
}

TEST(Pcap, PutsSegmentsInOrderWithTheTimesOfEach) {
    Capture capture;
    capture.segment(99, "", syn | ack).segment(103, "def").segment(106, "g").segment(100, "abc");
    EXPECT_THAT(capture.pieces(), ElementsAre(RecordedBytes{Way::from_scanner, at(3), "abc"},
                                              RecordedBytes{Way::from_scanner, at(1), "def"},
                                              RecordedBytes{Way::from_scanner, at(2), "g"}));
}

TEST(Pcap, CountsSegmentsThatComeTwiceOnce) {
    Capture capture;
    capture.segment(99, "", syn | ack).segment(100, "abc").segment(100, "abc");
    capture.segment(99, "", syn | ack).segment(101, "bcdef").segment(110, "k");
    capture.segment(108, "ij").segment(108, "ijk").segment(106, "gh");
    EXPECT_EQ(capture.text(), "abcdefghijk");
}

TEST(Pcap, WrapsItsNumbers) {
    Capture capture;
    capture.segment(0xFFFFFFFD, "", syn | ack).segment(2, "ef").segment(5, "h");
    capture.segment(0xFFFFFFFE, "abcd").segment(4, "g");
    EXPECT_EQ(capture.text(), "abcdefgh");
}

TEST(Pcap, SkipsGapsAcrossTheWrap) {
    Capture capture;
    capture.segment(0xFFFFFFF0, "a").segment(3, "c").segment(0xFFFFFFF8, "b");
    const auto recording = capture.opened();
    std::string text;
    for (const RecordedBytes& piece : Capture::pieces_of(*recording))
        text += piece.bytes;
    EXPECT_EQ(text, "abc");
    EXPECT_THAT(recording->warnings(),
                ElementsAre(HasSubstr("10.0.0.2:50000: the capture lacks 17 bytes")));
}

TEST(Pcap, BeginsInTheMiddle) {
    Capture capture;
    capture.segment(5000, "abc").asked(7000, "QT\n").segment(5003, "d");
    EXPECT_THAT(capture.pieces(), ElementsAre(RecordedBytes{Way::from_scanner, at(0), "abc"},
                                              RecordedBytes{Way::to_scanner, at(1), "QT\n"},
                                              RecordedBytes{Way::from_scanner, at(2), "d"}));
}

TEST(Pcap, DoesNotWaitForEverForASegmentThatIsLost) {
    Capture capture;
    capture.segment(99, "", syn | ack);
    std::uint32_t sequence = 101;
    for (int i = 0; i < 1000; ++i, sequence += 1000)
        capture.segment(sequence, std::string(1000, 'x'));
    capture.segment(100, "y");  // too late
    const auto recording = capture.opened();
    const auto pieces = Capture::pieces_of(*recording);
    EXPECT_EQ(pieces.size(), 1000U);
    EXPECT_EQ(pieces.at(0), (RecordedBytes{Way::from_scanner, at(1), std::string(1000, 'x')}));
    EXPECT_THAT(recording->warnings(), ElementsAre(HasSubstr("lacks 1 bytes")));
}

TEST(Pcap, NumbersConnectionsThatUseAPortAgain) {
    Capture capture;
    capture.asked(99, "", syn).asked(100, "VV\n").asked(99, "", syn).asked(103, "PP\n");
    capture.asked(7, "", syn).segment(8, "", syn | ack).asked(8, "II\n");
    const auto recording = capture.opened();
    std::vector<std::string> texts(3);
    while (const auto item = recording->next().value())
        texts.at(item->stream) += std::get<RecordedBytes>(item->what).bytes;
    EXPECT_THAT(texts, ElementsAre("VV\nPP\n", "II\n", ""));
    ASSERT_EQ(recording->streams().size(), 2U);
    EXPECT_EQ(recording->streams()[1].name, "10.0.0.1:10940 with 10.0.0.2:50000 #2");
}

TEST(Pcap, PutsFragmentsTogether) {
    const std::string whole = tcp(scanner, client, 100, "0123456789abcdef");
    constexpr int more = 0x2000;
    const auto part = [&](std::size_t begin, std::size_t end, int flags) {
        return framed(ipv4(scanner, client, whole.substr(begin, end - begin),
                           static_cast<int>(begin / 8) | flags));
    };
    EXPECT_THAT(
        Capture{}.add(part(24, 36, 0)).add(part(0, 8, more)).add(part(8, 24, more)).pieces(),
        ElementsAre(RecordedBytes{Way::from_scanner, at(2), "0123456789abcdef"}));
    EXPECT_THAT(Capture{}.add(part(24, 36, 0)).add(part(0, 8, more)).pieces(), IsEmpty());
}

TEST(Pcap, FindsPacketsOnEachLink) {
    const std::string packet = ipv4(scanner, client, tcp(scanner, client, 100, "hello"));
    const std::string type = "\x08\0"s;
    const std::vector<std::pair<int, std::string>> frames = {
        {0, "\x02\0\0\0"s + packet},
        {1, std::string(12, 'm') + "\x81\0\0\x05"s + type + packet},
        {1, std::string(12, 'm') + "\x88\xA8\0\x05\x81\0\0\x06"s + type + packet},
        {101, packet},  // raw: 12 on this system
        {108, "\0\0\0\x02"s + packet},
        {113, std::string(14, '\0') + type + packet},
        {113, std::string(14, '\0') + "\x81\0\0\x05"s + type + packet},
        {228, packet},
        {276, type + std::string(18, '\0') + packet},
    };
    for (const auto& [link, frame] : frames)
        EXPECT_EQ(Capture(link).add(frame).text(), "hello") << link;
}

TEST(Pcap, ReadsVersion6) {
    const Port from{"\xFE\x80"s + std::string(13, '\0') + "\x01", 10940};
    const Port to{"\xFE\x80"s + std::string(13, '\0') + "\x02", 50000};
    const auto recording =
        Capture(229).add(ipv6(from, to, tcp(from, to, 1, "hello")) + "padded").opened();
    const auto pieces = Capture::pieces_of(*recording);
    EXPECT_THAT(pieces, ElementsAre(RecordedBytes{Way::from_scanner, at(0), "hello"}));
    EXPECT_EQ(recording->streams().at(0).name, "[fe80::1]:10940 with [fe80::2]:50000");
}

TEST(Pcap, ReadsOfACutPacketTheBytesThatAreThere) {
    const std::string whole =
        std::string(12, 'm') + "\x08\0"s + ipv4(scanner, client, tcp(scanner, client, 1, "hello"));
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const std::string text = Capture{}.add(whole.substr(0, size)).text();
        const std::size_t head = whole.size() - 5;
        EXPECT_EQ(text, size < head ? "" : std::string("hello").substr(0, size - head));
    }
}

TEST(Pcap, TakesNoTunnelsApart) {
    std::string packet = ipv4(scanner, client, tcp(scanner, client, 100, "hello"));
    while (packet.size() < 20'000) {
        packet = ipv4(scanner, client, packet);
        packet[9] = 4;  // IP in IP
    }
    EXPECT_EQ(Capture{}.add(framed(packet)).text(), "");
}

TEST(Pcap, LeavesOutConnectionsBeyondABound) {
    Capture capture;
    for (int i = 0; i < 50'002; ++i)
        capture.add(framed(ipv4(scanner, {"\x0A\0"s + big(i, 2), 50000},
                                tcp(scanner, {"", 50000 + i / 65536}, 100, "x"))));
    const auto recording = capture.opened();
    EXPECT_EQ(Capture::pieces_of(*recording).size(), 50'000U);
    EXPECT_THAT(recording->warnings(),
                ElementsAre(HasSubstr("a.pcap: has more than 50000 TCP connections")));
}

}  // namespace
}  // namespace scipd::tests
