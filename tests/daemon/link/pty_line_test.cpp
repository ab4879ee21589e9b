// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The tty as a serial line: drivers set its rate by ioctl and hear what a UART would make of it.
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include <gtest/gtest.h>
#include <termios.h>

#include "daemon/clock/wall_clock.h"
#include "daemon/device/device.h"
#include "daemon/link/line_rate.h"
#include "daemon/link/pty_port.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/scanner_wire.h"
#include "tests/support/temp_dir.h"
#include "tests/support/tty_rate.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using tests::ScannerWire;

class PtyLineTest : public testing::TestWithParam<int> {
  protected:
    ~PtyLineTest() override {
        if (!port_) return;
        port_->stop();
        run_for(10ms);
    }

    void serve(const LinkConfig& link) {
        SensorConfig config = ideal_sensor("URG-04LX");
        config.link = link;
        device_ = std::make_unique<Device>("robot", config, 1, world_, clock_);
        port_ = std::make_shared<PtyPort>(io_.get_executor(), link_);
        port_->serve(*device_, link);
    }

    [[nodiscard]] ScannerWire open_at(int rate) const {
        ScannerWire wire = ScannerWire::tty(link_);
        tests::set_tty_rate(wire.descriptor(), rate);
        return wire;
    }

    void run_for(std::chrono::milliseconds time) {
        io_.restart();
        io_.run_for(time);
    }

    static void read(ScannerWire& wire, std::string& bytes) {
        std::array<char, 1024> buffer;
        bytes.append(buffer.data(), wire.read(buffer, 0ms));
    }

    /// Whether this is all that comes, or the end of it.
    bool comes(ScannerWire& wire, std::string_view text) {
        std::string bytes;
        return run_until(io_, [&] {
            read(wire, bytes);
            return bytes.ends_with(text);
        });
    }

    /// What comes until nothing has come for 140 ms: as long as urg_library waits.
    std::string drained(ScannerWire& wire) {
        std::string bytes;
        for (std::size_t before = 1; before != bytes.size();) {
            before = bytes.size();
            run_for(140ms);
            read(wire, bytes);
        }
        return bytes;
    }

    boost::asio::io_context io_;
    WallClock clock_{io_.get_executor()};
    World world_ = wall_world();
    tests::TempDir directory_;
    std::filesystem::path link_ = directory_.path() / "tty";
    std::unique_ptr<Device> device_;
    std::shared_ptr<PtyPort> port_;
};

// A line break, 140 ms of silence, QT, at one rate after the other.
TEST_P(PtyLineTest, IsFoundByADriverThatTriesTheRates) {
    serve({.baud = GetParam()});
    ScannerWire wire = ScannerWire::tty(link_);
    int found = 0;
    for (const int rate : {115200, 57600, 19200, 250000, 500000, 750000}) {
        tests::set_tty_rate(wire.descriptor(), rate);
        wire.write("\n");
        (void)drained(wire);
        wire.write("QT\n");
        if (rate != GetParam()) {
            EXPECT_EQ(drained(wire).find("QT"), std::string::npos) << rate;
            continue;
        }
        found = rate;
        EXPECT_TRUE(comes(wire, "QT\n00P\n\n"));
        break;
    }
    EXPECT_EQ(found, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Rates, PtyLineTest, testing::Values(57600, 19200, 250000, 750000),
                         testing::PrintToStringParamName());

TEST_F(PtyLineTest, IsReadAtTheRateThatItIsSetTo) {
    serve({.baud = 19200});
    const ScannerWire wire = ScannerWire::tty(link_);
    for (const int rate : {19200, 115200, 123456, 250000, 750000}) {
        tests::set_tty_rate(wire.descriptor(), rate);
        EXPECT_EQ(line_rate(wire.descriptor()), rate);
    }
    // By its name, as most drivers do.
    termios settings{};
    ASSERT_EQ(::tcgetattr(wire.descriptor(), &settings), 0);
    ASSERT_EQ(::cfsetspeed(&settings, B57600), 0);
    ASSERT_EQ(::tcsetattr(wire.descriptor(), TCSANOW, &settings), 0);
    EXPECT_EQ(line_rate(wire.descriptor()), 57600);
    ASSERT_EQ(::cfsetspeed(&settings, B0), 0);
    ASSERT_EQ(::tcsetattr(wire.descriptor(), TCSANOW, &settings), 0);
    EXPECT_GT(line_rate(wire.descriptor()), 0);
}

TEST_F(PtyLineTest, FollowsSSAndGoesBackWithRS) {
    serve({.baud = 19200});
    ScannerWire wire = open_at(19200);
    wire.write("SS750000\n");
    EXPECT_TRUE(comes(wire, "SS750000\n00P\n\n"));
    tests::set_tty_rate(wire.descriptor(), 750000);
    wire.write("SS750000\n");
    EXPECT_TRUE(comes(wire, "SS750000\n03S\n\n"));
    wire.write("RS\n");
    EXPECT_TRUE(comes(wire, "RS\n00P\n\n"));
    wire.write("QT\n");
    EXPECT_EQ(drained(wire).find("QT"), std::string::npos);
    tests::set_tty_rate(wire.descriptor(), 19200);
    wire.write("\nQT\n");
    EXPECT_TRUE(comes(wire, "QT\n00P\n\n"));
}

TEST_F(PtyLineTest, KeepsItsRateWhenADriverHasGone) {
    serve({.baud = 19200});
    {
        ScannerWire wire = open_at(19200);
        wire.write("SS115200\n");
        EXPECT_TRUE(comes(wire, "SS115200\n00P\n\n"));
    }
    EXPECT_TRUE(run_until(io_, [&] { return !port_->connected(); }));
    ScannerWire wire = open_at(115200);
    wire.write("QT\n");
    EXPECT_TRUE(comes(wire, "QT\n00P\n\n"));
}

TEST_F(PtyLineTest, TakesAnyRateWhereItIsUsb) {
    serve({});
    ScannerWire wire = open_at(9600);
    wire.write("SS115200\n");
    EXPECT_TRUE(comes(wire, "SS115200\n00P\n\n"));
    for (const int rate : {19200, 250000}) {
        tests::set_tty_rate(wire.descriptor(), rate);
        wire.write("QT\n");
        EXPECT_TRUE(comes(wire, "QT\n00P\n\n"));
    }
}

TEST_F(PtyLineTest, GoesOnUnheardWhenItIsClosedIfSo) {
    serve({.stop_on_close = false});
    {
        ScannerWire wire = open_at(19200);
        wire.write("MD0384038400000\n");
        EXPECT_TRUE(comes(wire, "MD0384038400000\n00P\n\n"));
    }
    EXPECT_TRUE(run_until(io_, [&] { return !port_->connected(); }));
    EXPECT_TRUE(device_->wanted());
}

TEST_F(PtyLineTest, EndsWhatWasBegunOnItWhenItIsClosed) {
    serve({});
    {
        ScannerWire wire = open_at(19200);
        wire.write("MD0384038400000\n");
        EXPECT_TRUE(comes(wire, "MD0384038400000\n00P\n\n"));
        EXPECT_TRUE(device_->wanted());
    }
    EXPECT_TRUE(run_until(io_, [&] { return !port_->connected(); }));
    EXPECT_FALSE(device_->wanted());
    EXPECT_FALSE(device_->state().laser_on());
    ScannerWire wire = open_at(19200);
    wire.write("BM\n");
    EXPECT_TRUE(comes(wire, "BM\n00P\n\n"));
}

}  // namespace
}  // namespace scipd::daemon
