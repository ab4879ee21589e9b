// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The log of scipd as a process: that it holds nobody up, and what it tells of clients.
#include <array>
#include <csignal>
#include <regex>
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
    static std::size_t count(const std::string& log, const std::string& words) {
        std::size_t times = 0;
        for (auto at = log.find(words); at != log.npos; at = log.find(words, at + 1))
            ++times;
        return times;
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
    EXPECT_THAT(log, HasSubstr("robot/scanner: client connected from 127.0.0.1:"));
    EXPECT_THAT(log, HasSubstr("robot/scanner: laser on, by the TCP client"));
    EXPECT_THAT(log, HasSubstr("robot/scanner: client disconnected (closed the connection)"));
    EXPECT_THAT(log, Not(HasSubstr("hears")));
}

// All of it within much less than a second.
TEST_F(LogOfClients, MissesNoChangeOfAClientThatComesAndGoes) {
    DaemonProcess daemon(directory_, at("info"));
    ASSERT_NE(daemon.ready_line(), "");
    for (int i = 0; i < 2; ++i) {
        ScannerWire wire = ScannerWire::tcp(daemon.port());
        for (const char* const request : {"BM", "QT", "BM", "RS"})
            EXPECT_EQ(wire.ask(request), "00");
    }
    ASSERT_TRUE(eventually([&] { return daemon.get("/sensors")[0].at("clients") == 0; }));
    const std::string log = told(daemon);
    EXPECT_EQ(count(log, "client connected from"), 2U) << log;
    EXPECT_EQ(count(log, "laser on, by the TCP client"), 4U) << log;
    EXPECT_EQ(count(log, "laser off, by the TCP client"), 4U) << log;
    EXPECT_EQ(count(log, "client disconnected"), 2U) << log;
    EXPECT_EQ(count(log, "suppressed"), 0U) << log;
}

TEST_F(LogOfClients, CountsWhatItLeavesOutOnceThatCalmsDown) {
    Arguments words = at("info");
    words.insert(words.end(), {"--timing", "ideal"});
    DaemonProcess daemon(directory_, words);
    ASSERT_NE(daemon.ready_line(), "");
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    constexpr std::size_t switches = 400;
    for (std::size_t i = 0; i < switches / 2; ++i) {
        EXPECT_EQ(wire.ask("BM"), "00");
        EXPECT_EQ(wire.ask("QT"), "00");
    }
    // While the client is still there and nothing else happens.
    const std::string last = " suppressed, the last: laser off, by the TCP client\n";
    ASSERT_TRUE(eventually([&] { return count(daemon.standard_error(), last) > 0; }))
        << daemon.standard_error();
    const std::string log = daemon.standard_error();
    std::size_t suppressed = 0;
    const std::regex number("(\\d+) similar messages? suppressed");
    for (std::sregex_iterator at(log.begin(), log.end(), number), end; at != end; ++at)
        suppressed += std::stoul((*at)[1]);
    const std::size_t told_of = count(log, ": laser on") + count(log, ": laser off");
    EXPECT_GE(told_of, 19U);
    EXPECT_EQ(told_of - count(log, last) + suppressed, switches) << log;
}

TEST_F(LogOfClients, TellsWhoWaitsForWhomAndSoDoesTheStatus) {
    DaemonProcess daemon(directory_, at("info"));
    ASSERT_NE(daemon.ready_line(), "");
    ScannerWire first = ScannerWire::tcp(daemon.port());
    EXPECT_EQ(first.ask("VV"), "00");
    const ScannerWire second = ScannerWire::tcp(daemon.port());
    const nlohmann::json one{local_address(first)};
    const nlohmann::json other{local_address(second)};
    ASSERT_TRUE(eventually([&] { return daemon.get("/sensors")[0].at("waiting") == other; }));
    EXPECT_EQ(daemon.get("/sensors")[0].at("connected"), one);
    EXPECT_EQ(daemon.get("/sensors")[0].at("clients"), 1);
    first.close();
    EXPECT_TRUE(eventually([&] { return daemon.get("/sensors")[0].at("connected") == other; }));
    EXPECT_TRUE(daemon.get("/sensors")[0].at("waiting").empty());
    EXPECT_THAT(told(daemon),
                HasSubstr("robot/scanner: client from " + other[0].get<std::string>() +
                          " waits until " + one[0].get<std::string>() + " disconnects"));
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
