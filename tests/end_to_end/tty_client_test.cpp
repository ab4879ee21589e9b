// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Drivers open the tty, set it up in any way, close it and open it again.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <termios.h>

#include "tests/end_to_end/in_square_room.h"

namespace scipd::tests {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

termios settings_of(const ScannerWire& wire) {
    termios settings{};
    EXPECT_EQ(::tcgetattr(wire.descriptor(), &settings), 0);
    return settings;
}

void expect_raw(const ScannerWire& wire) {
    const termios settings = settings_of(wire);
    EXPECT_EQ(settings.c_lflag & (ECHO | ECHONL | ICANON | ISIG | IEXTEN), 0U);
    EXPECT_EQ(settings.c_iflag & (ICRNL | INLCR | IGNCR | IXON | ISTRIP | BRKINT | PARMRK), 0U);
    EXPECT_EQ(settings.c_oflag & OPOST, 0U);
    EXPECT_EQ(settings.c_cflag & CSIZE, static_cast<tcflag_t>(CS8));
}

std::string read_for(ScannerWire& wire, std::chrono::milliseconds time) {
    std::string text;
    const auto end = std::chrono::steady_clock::now() + time;
    while (std::chrono::steady_clock::now() < end) {
        std::array<char, 4096> buffer;
        text.append(buffer.data(), wire.read(buffer, 20ms));
    }
    return text;
}

class TtyClient : public testing::Test {
  protected:
    TtyClient() : daemon_(directory_, on_tty()) {}
    explicit TtyClient(const std::string& link)
        : daemon_(directory_,
                  {"--config",
                   directory_.write("tty.yaml",
                                    "scene: " + scene("square_room.sdf").string() +
                                        "\nrobots: {r: {sensors: {s: {model: UST-10LX, pty: auto, "
                                        "link: " +
                                        link + "}}}}\n")}) {}

    [[nodiscard]] ScannerWire open() const { return ScannerWire::tty(daemon_.tty()); }
    [[nodiscard]] int scans() const { return daemon_.sensor_status().at("scans").get<int>(); }
    [[nodiscard]] bool seen_open() const { return daemon_.sensor_status().at("clients") == 1; }

    TempDir directory_;
    DaemonProcess daemon_;
};

TEST_F(TtyClient, FindsItRawAndHearsNoEcho) {
    ScannerWire wire = open();
    expect_raw(wire);
    wire.write("QT\n");
    EXPECT_EQ(read_for(wire, 500ms), "QT\n00P\n\n");
}

TEST_F(TtyClient, FindsItRawAfterOneWhoChangedEverything) {
    {
        ScannerWire wire = open();
        termios settings = settings_of(wire);
        settings.c_lflag |= ECHO | ICANON | ISIG;
        settings.c_iflag |= ICRNL | IXON;
        settings.c_oflag |= OPOST | ONLCR;
        ::cfsetspeed(&settings, B9600);
        EXPECT_EQ(::tcsetattr(wire.descriptor(), TCSANOW, &settings), 0);
        EXPECT_EQ(::tcflow(wire.descriptor(), TCOOFF), 0);
        EXPECT_EQ(::ioctl(wire.descriptor(), TIOCEXCL), 0);
        ASSERT_TRUE(eventually([&] { return seen_open(); }));
    }
    ASSERT_TRUE(eventually([&] { return !seen_open(); }));
    ScannerWire wire = open();
    expect_raw(wire);
    int exclusive = -1;
    EXPECT_EQ(::ioctl(wire.descriptor(), TIOCGEXCL, &exclusive), 0);
    EXPECT_EQ(exclusive, 0);
    wire.write("QT\n");
    EXPECT_EQ(read_for(wire, 500ms), "QT\n00P\n\n");
}

TEST_F(TtyClient, FindsItSilentAfterOneThatDiedInMidStream) {
    {
        ScannerWire wire = open();
        EXPECT_EQ(wire.ask(stream_of_all_beams), "00");
        (void)wire.next_scan();
    }
    ASSERT_TRUE(eventually([&] { return !seen_open(); }));
    EXPECT_EQ(daemon_.sensor_status().at("state"), "standby");
    ScannerWire wire = open();
    EXPECT_EQ(read_for(wire, 200ms), "");
    EXPECT_EQ(wire.ask(stream_of_all_beams), "00");
    EXPECT_EQ(wire.next_scan().distances_mm.size(), 1081U);
}

class TtyClientWhereStreamsGoOn : public TtyClient {
  protected:
    TtyClientWhereStreamsGoOn() : TtyClient("{on_close: keep}") {}
};

TEST_F(TtyClientWhereStreamsGoOn, FindsItsStreamStillRunning) {
    const fs::path target = fs::read_symlink(daemon_.tty());
    std::uint32_t last_stamp_ms = 0;
    {
        ScannerWire wire = open();
        EXPECT_EQ(wire.ask(stream_of_all_beams), "00");
        last_stamp_ms = wire.next_scan().stamp_ms;
        // Unread scans fill the kernel's buffer, which then ends in the middle of a message.
        const int before = scans();
        ASSERT_TRUE(eventually([&] { return scans() >= before + 10; }));
    }
    ASSERT_TRUE(eventually([&] { return !seen_open(); }));
    const int closed = scans();
    ASSERT_TRUE(eventually([&] { return scans() >= closed + 10; }));

    EXPECT_EQ(fs::read_symlink(daemon_.tty()), target);
    ScannerWire wire = open();
    // Nothing of the time in between is left, and messages are whole.
    auto scan = wire.next_scan();
    EXPECT_GE(scan.stamp_ms, last_stamp_ms + 20 * 25);
    for (int i = 0; i < 10; ++i) {
        const auto next = wire.next_scan();
        EXPECT_EQ(turns_between(scan.stamp_ms, next.stamp_ms), 1);
        scan = next;
    }
    EXPECT_EQ(wire.ask("QT"), "00");
}

TEST_F(TtyClient, KeepsItWhenAnotherOpensAndClosesItToo) {
    // Both open the tty before the daemon looks.
    daemon_.signal(SIGSTOP);
    ScannerWire wire = open();
    ScannerWire other = open();
    daemon_.signal(SIGCONT);
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    other.close();
    for (int i = 0; i < 40; ++i)
        (void)wire.next_scan();
    EXPECT_TRUE(seen_open());
}

TEST_F(TtyClient, IsSeenToGoWhenSeveralGoAtOnce) {
    ScannerWire wire = open();
    ASSERT_TRUE(eventually([&] { return seen_open(); }));
    ScannerWire other = open();
    EXPECT_EQ(other.ask("VV"), "00");
    daemon_.signal(SIGSTOP);
    wire.close();
    other.close();
    daemon_.signal(SIGCONT);
    EXPECT_TRUE(eventually([&] { return !seen_open(); }));
}

TEST(TcpAndTty, AreTwoSessionsOnOneDevice) {
    const TempDir directory;
    const DaemonProcess daemon(directory,
                               in_square_room({"--tcp", "127.0.0.1:0", "--accuracy", "ideal"}));
    ScannerWire tcp = ScannerWire::tcp(daemon.port());
    ScannerWire tty = ScannerWire::tty(daemon.tty());
    EXPECT_EQ(tcp.ask(stream_of_one_beam), "00");
    EXPECT_EQ(tty.ask(stream_of_all_beams), "00");
    EXPECT_EQ(tcp.next_scan().distances_mm, std::vector<std::uint32_t>{3000});
    EXPECT_EQ(tty.next_scan().distances_mm.size(), 1081U);
    EXPECT_EQ(daemon.sensor_status().at("clients"), 2);

    EXPECT_EQ(tcp.ask("QT"), "00");
    EXPECT_FALSE(tcp.next_message(300ms));
    // The other client's stream has no gap.
    std::uint32_t stamp_ms = tty.next_scan().stamp_ms;
    for (int i = 0; i < 20; ++i) {
        const std::uint32_t next_ms = tty.next_scan().stamp_ms;
        EXPECT_EQ(turns_between(stamp_ms, next_ms), 1);
        stamp_ms = next_ms;
    }
    EXPECT_EQ(daemon.sensor_status().at("state"), "streaming");

    EXPECT_EQ(tty.ask("QT"), "00");
    EXPECT_EQ(daemon.sensor_status().at("state"), "standby");
}

}  // namespace
}  // namespace scipd::tests
