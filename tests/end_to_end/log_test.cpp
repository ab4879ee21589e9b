// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The log of scipd as a process: that it holds nobody up, and what it tells of clients.
#include <array>
#include <csignal>
#include <string>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/end_to_end/in_square_room.h"

namespace scipd::tests {
namespace {

using testing::HasSubstr;
using testing::Not;

class FullPipe {
  public:
    FullPipe() {
        if (::pipe2(ends_.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
        const std::string bytes(static_cast<std::size_t>(::fcntl(ends_[1], F_GETPIPE_SZ)), '.');
        if (::write(ends_[1], bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
            throw std::runtime_error("the pipe is not full");
    }
    ~FullPipe() {
        ::close(ends_[0]);
        ::close(ends_[1]);
    }
    FullPipe(const FullPipe&) = delete;
    FullPipe& operator=(const FullPipe&) = delete;

    [[nodiscard]] int descriptor() const { return ends_[1]; }

  private:
    std::array<int, 2> ends_{};
};

TEST(Log, ThatNobodyReadsHoldsNobodyUp) {
    const TempDir directory;
    const FullPipe error;
    DaemonProcess daemon(directory, on_tcp(), {.error = error.descriptor()});
    ASSERT_NE(daemon.ready_line(), "");
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    std::uint32_t stamp_ms = wire.next_scan().stamp_ms;
    for (int i = 0; i < 40; ++i) {
        daemon.signal(SIGHUP);  // warns, as there is no configuration to read again
        EXPECT_EQ(daemon.get("/sensors").size(), 1U);
        const std::uint32_t next_ms = wire.next_scan().stamp_ms;
        ASSERT_EQ(turns_between(stamp_ms, next_ms), 1);
        stamp_ms = next_ms;
    }
    daemon.signal(SIGTERM);
    EXPECT_EQ(daemon.wait(), 0);
}

class LogOfClients : public testing::Test {
  protected:
    /// Ends the daemon, and returns all that it has told.
    static std::string told(DaemonProcess& daemon) {
        daemon.signal(SIGTERM);
        EXPECT_EQ(daemon.wait(), 0);
        return daemon.standard_error();
    }
    Arguments at(const std::string& level) {
        Arguments words = on_tcp();
        words.insert(words.end(), {"--log-level", level});
        return words;
    }

    TempDir directory_;
};

TEST_F(LogOfClients, TellsWhoComesAndGoesAndWhatTheyDo) {
    DaemonProcess daemon(directory_, at("info"));
    ASSERT_NE(daemon.ready_line(), "");
    {
        ScannerWire wire = ScannerWire::tcp(daemon.port());
        EXPECT_EQ(wire.ask("BM"), "00");
        EXPECT_EQ(wire.ask("RS"), "00");
    }
    ScannerWire next = ScannerWire::tcp(daemon.port());
    EXPECT_EQ(next.ask("VV"), "00");
    const std::string log = told(daemon);
    EXPECT_THAT(log, HasSubstr("robot/scanner: a client came from 127.0.0.1:"));
    EXPECT_THAT(log, HasSubstr("robot/scanner: laser on, by the TCP client"));
    EXPECT_THAT(log, HasSubstr("robot/scanner: the client has left: it has closed its side"));
    EXPECT_THAT(log, Not(HasSubstr("hears")));
}

TEST_F(LogOfClients, TellsEachRequestAndItsStatusWhereItIsToDebug) {
    DaemonProcess daemon(directory_, at("debug"));
    ASSERT_NE(daemon.ready_line(), "");
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    EXPECT_EQ(wire.ask("BM"), "00");
    EXPECT_EQ(wire.ask("BM"), "02");
    EXPECT_NE(wire.ask("PP9"), "00");
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    (void)wire.next_scan();
    const std::string log = told(daemon);
    EXPECT_THAT(log, HasSubstr("debug robot/scanner: tcp hears BM: "));
    EXPECT_THAT(log, HasSubstr("robot/scanner: tcp answers BM with 02: the laser is on already"));
    EXPECT_THAT(log, HasSubstr("robot/scanner: tcp answers PP9 with "));
    // Forty scans a second would hide all else.
    EXPECT_THAT(log, Not(HasSubstr("with 99")));
}

}  // namespace
}  // namespace scipd::tests
