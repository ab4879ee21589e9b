// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/uart.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "protocol/client/decoder.h"
#include "protocol/reply.h"

namespace scipd::daemon {
namespace {

constexpr std::array rates{19200, 38400, 57600, 115200, 250000, 500000, 750000};

std::string every_byte() {
    std::string bytes;
    for (int byte = 0; byte < 256; ++byte)
        bytes += static_cast<char>(byte);
    return bytes;
}

/// Replies with right sums, of all lengths, with blocks of data that differ from each other.
std::vector<std::string> replies() {
    std::vector<std::string> all{protocol::Reply("QT", "00").finish(),
                                 protocol::Reply("SCIP2.0", "0E").finish()};
    for (int length = 1; length < 300; length += 7) {
        std::string data;
        for (int i = 0; i < length; ++i)
            data += static_cast<char>(0x30 + (i * i * 7 + length) % 64);
        protocol::Reply reply("MD0000076801000", "99");
        all.push_back(reply.line("0aB1").data(data).finish());
    }
    return all;
}

bool makes_sense(std::string_view bytes) {
    protocol::client::Decoder decoder;
    while (const auto message = decoder.next(bytes)) {
        // One character of status has no sum: SCIP 1.1, which none of these is.
        if (!message->damage && message->status.size() == 2) return true;
    }
    return false;
}

std::string in_pieces(const std::string& bytes, std::size_t size, int sent_at, int read_at) {
    std::string all;
    for (std::size_t begin = 0; begin < bytes.size(); begin += size)
        all += heard(bytes.substr(begin, size), sent_at, read_at);
    return all;
}

TEST(Uart, UnderstandsItsOwnRate) {
    for (const int rate : rates)
        EXPECT_EQ(heard(every_byte(), rate, rate), every_byte());
}

TEST(Uart, UnderstandsARateThatIsAlmostItsOwn) {
    for (const int rate : rates) {
        for (const int per_mille : {-40, -20, -1, 1, 20, 40}) {
            const int other = rate + rate * per_mille / 1000;
            EXPECT_EQ(heard(every_byte(), rate, other), every_byte()) << rate << " " << other;
        }
    }
}

// Worked out on paper, bit by bit.
TEST(Uart, SamplesTheMiddleOfWhatItTakesForBits) {
    // ‾\_/‾‾‾‾: a start bit as long as two of the receiver's.
    EXPECT_EQ(heard("\xff", 19200, 38400), "\xfe");
    // 0 11110000 1 at half the receiver's rate: 0 01111111 1, then 0 00000001 1.
    EXPECT_EQ(heard("\x0f", 19200, 38400), "\xfe\x80");
    // 0 10101010 1, read at 0.75, 2.25, 3.75, 5.25, 6.75, 8.25, 9.75 ... of the sender's bits.
    EXPECT_EQ(heard("U", 57600, 38400), "\xe6");
    // 0 11111111 1 twice: the start bit is over before a slow receiver looks at it.
    EXPECT_EQ(heard("\xff\xff", 750000, 19200), "");
    // At a third of the rate: the two start bits are edges, 0.5 of 3 bits later it is
    // high.
    EXPECT_EQ(heard("\xff\xff", 750000, 250000), "");
}

TEST(Uart, HandsOutZeroWhereThereIsNoStopBit) {
    // 0 11110000 1 at a third of the receiver's rate: 000 111111 1.. is fc, and then it is low for
    // twelve bits.
    EXPECT_EQ(heard("\x0f", 19200, 57600), std::string("\xfc\0", 2));
    // Low for 18 bits, as only a start bit and eight zeros are.
    EXPECT_EQ(heard(std::string(1, '\0'), 19200, 38400), std::string(1, '\0'));
}

TEST(Uart, MakesNoSenseOfAReplyAtAnotherRate) {
    for (const std::string& reply : replies()) {
        ASSERT_TRUE(makes_sense(reply));
        for (const int sent_at : rates) {
            for (const int read_at : rates) {
                EXPECT_EQ(makes_sense(heard(reply, sent_at, read_at)), sent_at == read_at);
                EXPECT_EQ(makes_sense(in_pieces(reply, 2, sent_at, read_at)), sent_at == read_at)
                    << reply << sent_at << " read at " << read_at;
            }
        }
    }
}

TEST(Uart, MakesNoRequestOfOneAtAnotherRate) {
    for (const std::string request :
         {"QT\n", "VV\n", "\n", "PP\n", "TM2\n", "SS115200\n", "RS\n"}) {
        for (const int sent_at : rates) {
            for (const int read_at : rates) {
                if (sent_at == read_at) continue;
                const std::string noise = heard(request, sent_at, read_at);
                EXPECT_EQ(noise.find(request.substr(0, 2)), std::string::npos);
            }
        }
    }
}

}  // namespace
}  // namespace scipd::daemon
