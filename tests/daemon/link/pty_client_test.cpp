// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One client of a tty after another: nothing of the first reaches the second, whatever it had
// asked, changed or left unread, also where the daemon has not yet seen that it is gone.
#include <array>
#include <filesystem>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <termios.h>

#include "daemon/clock/wall_clock.h"
#include "daemon/device/device.h"
#include "daemon/link/pty_port.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/scanner_wire.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using tests::ScannerWire;

class PtyClients : public testing::Test {
  protected:
    ~PtyClients() override {
        port_->stop();
        run_for(10ms);
    }

    void serve(const LinkConfig& link) { port_->serve(device_, link); }

    [[nodiscard]] ScannerWire open() const { return ScannerWire::tty(port_->address()); }

    void run_for(std::chrono::milliseconds time) {
        io_.restart();
        io_.run_for(time);
    }

    static std::string read(ScannerWire& wire) {
        std::array<char, 4096> buffer;
        std::string bytes;
        while (const std::size_t count = wire.read(buffer, 0ms))
            bytes.append(buffer.data(), count);
        return bytes;
    }

    bool comes(ScannerWire& wire, const std::string& text) {
        std::string received;
        return run_until(io_, [&] {
            received += read(wire);
            return received == text;
        });
    }

    void wait_until_closed() {
        ASSERT_TRUE(run_until(io_, [&] { return !port_->connected(); }));
    }

    /// It is answered that, and nothing else comes before.
    void expect_a_clean_start(ScannerWire wire) {
        run_for(100ms);
        EXPECT_EQ(read(wire), "");
        wire.write("QT\n");
        EXPECT_TRUE(comes(wire, "QT\n00P\n\n"));
    }

    boost::asio::io_context io_;
    WallClock clock_{io_.get_executor()};
    World world_ = wall_world();
    Device device_{"robot", ideal_sensor(), 1, world_, clock_};
    tests::TempDir directory_;
    std::shared_ptr<PtyPort> port_ =
        std::make_shared<PtyPort>(io_.get_executor(), directory_.path() / "tty");
};

/// Whether closing it ends what was begun.
class NextClient : public PtyClients, public testing::WithParamInterface<bool> {};

INSTANTIATE_TEST_SUITE_P(OnClose, NextClient, testing::Bool(),
                         [](const auto& stop) { return stop.param ? "Stop" : "Keep"; });

TEST_P(NextClient, DoesNotEndTheRequestOfTheOneBefore) {
    serve({.stop_on_close = GetParam()});
    {
        ScannerWire wire = open();
        wire.write("MD0540");
        ASSERT_TRUE(run_until(io_, [&] { return port_->connected(); }));
        run_for(20ms);
    }
    wait_until_closed();
    expect_a_clean_start(open());
}

TEST_P(NextClient, IsNotAnsweredWhatTheOneBeforeAsked) {
    serve({.latency = 20ms, .stop_on_close = GetParam()});
    {
        ScannerWire wire = open();
        wire.write("VV\nPP\n");
        run_for(30ms);  // one answer is under way
        wire.write("BM\n");
        run_for(5ms);
    }
    wait_until_closed();
    expect_a_clean_start(open());
    EXPECT_FALSE(device_.state().laser_on());
}

TEST_P(NextClient, GetsNoScanThatTheOneBeforeAskedFor) {
    serve({.stop_on_close = GetParam()});
    {
        ScannerWire wire = open();
        wire.write("BM\nGD0540054000\n");
        ASSERT_TRUE(run_until(io_, [&] { return device_.wanted(); }));
    }
    wait_until_closed();
    EXPECT_FALSE(device_.wanted());
    ScannerWire wire = open();
    ASSERT_TRUE(run_until(io_, [&] { return port_->connected(); }));
    device_.turn_complete(device_.next_revolution());
    expect_a_clean_start(std::move(wire));
}

TEST_P(NextClient, IsNotTakenForTheOneBeforeWhoWasNotHeardInTime) {
    serve({.stop_on_close = GetParam()});
    for (const char* left : {"MD0540054000000\n", "MD05400"}) {
        {
            ScannerWire wire = open();
            ASSERT_TRUE(run_until(io_, [&] { return port_->connected(); }));
            wire.write(left);
        }
        expect_a_clean_start(open());
        wait_until_closed();
    }
    EXPECT_FALSE(device_.wanted());
}

TEST_P(NextClient, IsHeardThoughTheOneBeforeIsNotSeenToGo) {
    serve({.stop_on_close = GetParam()});
    for (int round = 0; round < 5; ++round) {
        ScannerWire wire = open();
        wire.write("QT\n");
        EXPECT_TRUE(comes(wire, "QT\n00P\n\n"));
        run_for(10ms);
    }
}

/// As vhangup() does; only root may.
bool hang_up(const ScannerWire& wire) {
    return ::ioctl(wire.descriptor(), TIOCVHANGUP) == 0;
}

void leave_modes(const ScannerWire& wire) {
    termios settings{};
    EXPECT_EQ(::tcgetattr(wire.descriptor(), &settings), 0);
    settings.c_lflag |= ECHO | ICANON;
    EXPECT_EQ(::tcsetattr(wire.descriptor(), TCSANOW, &settings), 0);
    EXPECT_EQ(::tcflow(wire.descriptor(), TCOOFF), 0);
    EXPECT_EQ(::ioctl(wire.descriptor(), TIOCEXCL), 0);
}

void expect_no_modes(const ScannerWire& wire) {
    termios settings{};
    EXPECT_EQ(::tcgetattr(wire.descriptor(), &settings), 0);
    EXPECT_EQ(settings.c_lflag & (ECHO | ICANON | ISIG), 0U);
    EXPECT_EQ(settings.c_oflag & OPOST, 0U);
    int exclusive = -1;
    EXPECT_EQ(::ioctl(wire.descriptor(), TIOCGEXCL, &exclusive), 0);
    EXPECT_EQ(exclusive, 0);
}

TEST_F(PtyClients, FindNoModeOfOneThatWasHungUp) {
    serve({});
    for (int round = 0; round < 2; ++round) {
        {
            ScannerWire wire = open();
            wire.write("MD0540054000000\n");
            ASSERT_TRUE(comes(wire, "MD0540054000000\n00P\n\n"));
            leave_modes(wire);
            if (!hang_up(wire)) GTEST_SKIP() << "only root may hang up a tty";
        }
        wait_until_closed();
        EXPECT_FALSE(device_.wanted());
        ScannerWire wire = open();
        ASSERT_TRUE(run_until(io_, [&] { return port_->connected(); }));
        expect_no_modes(wire);
        expect_a_clean_start(std::move(wire));
        wait_until_closed();
    }
}

// One that was cut off keeps its descriptor, so that the tty is never seen to be closed.
TEST_F(PtyClients, NeedNotWaitUntilOneThatWasHungUpHasClosed) {
    serve({});
    ScannerWire cut_off = open();
    cut_off.write("MD0540054000000\n");
    ASSERT_TRUE(comes(cut_off, "MD0540054000000\n00P\n\n"));
    {
        const ScannerWire wire = open();
        leave_modes(wire);
        if (!hang_up(wire)) GTEST_SKIP() << "only root may hang up a tty";
    }
    EXPECT_TRUE(run_until(io_, [&] { return !device_.wanted(); }));
    ScannerWire wire = open();
    expect_no_modes(wire);
    expect_a_clean_start(std::move(wire));
    cut_off.close();
    wait_until_closed();
    expect_a_clean_start(open());
}

}  // namespace
}  // namespace scipd::daemon
