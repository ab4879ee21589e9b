// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A line that changes while a client is connected: on a clock that is stepped by hand, by way of a
// port and a real socket.
#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/clock/stepped_clock.h"
#include "daemon/device/device.h"
#include "daemon/link/line_hook.h"
#include "daemon/link/tcp_port.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/scanner_wire.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using tests::ScannerWire;

/// Changes an X for a Y, loses what has an L, and remembers all.
class RecordingHook : public LineHook {
  public:
    void leaving(protocol::Send& message) override {
        left.push_back(message.bytes);
        if (message.bytes.find('L') != std::string::npos) message.bytes.clear();
        for (char& c : message.bytes)
            c = c == 'X' ? 'Y' : c;
    }
    void connected(Port& port) override { ports.push_back(&port); }

    std::vector<std::string> left;
    std::vector<Port*> ports;
};

class LineStateTest : public testing::Test {
  protected:
    LineStateTest() { port_->serve(device_); }
    ~LineStateTest() override {
        port_->stop();
        turn();
    }

    void turn() {
        io_.restart();
        io_.run_for(20ms);
    }

    [[nodiscard]] ScannerWire connect() {
        ScannerWire wire = ScannerWire::tcp(tests::port_of(port_->address()));
        EXPECT_TRUE(run_until(io_, [&] { return port_->connected(); }));
        return wire;
    }

    /// What it has received when this has come, or nothing comes any more.
    std::string received(ScannerWire& wire, const std::string& until) {
        std::string all;
        const bool came = run_until(io_, [&] {
            std::array<char, 4096> buffer;
            all.append(buffer.data(), wire.read(buffer, 0ms));
            return all.ends_with(until);
        });
        EXPECT_TRUE(came) << all;
        return all;
    }
    std::string received_by_now(ScannerWire& wire) {
        turn();
        std::array<char, 65536> buffer;
        return {buffer.data(), wire.read(buffer, 0ms)};
    }

    boost::asio::io_context io_;
    SteppedClock clock_;
    World world_ = wall_world();
    Device device_{"robot", ideal_sensor(), 1, world_, clock_};
    std::shared_ptr<TcpPort> port_ =
        std::make_shared<TcpPort>(io_.get_executor(), Address{"127.0.0.1", 0});
};

TEST_F(LineStateTest, IsLateForWhoIsConnectedAndForWhoComesLater) {
    ScannerWire first = connect();
    port_->set_line({.link = {.latency = 10ms}});
    const auto is_late = [&](ScannerWire& wire, sim::Time now) {
        wire.write("QT\n");
        EXPECT_EQ(received_by_now(wire), "");
        clock_.advance_to(now + 10ms);
        EXPECT_EQ(received_by_now(wire), "");
        clock_.advance_to(now + 20ms);
        EXPECT_EQ(received(wire, "\n\n"), "QT\n00P\n\n");
    };
    is_late(first, 0ms);
    first.close();
    EXPECT_TRUE(run_until(io_, [&] { return !port_->connected(); }));
    ScannerWire second = connect();
    is_late(second, 20ms);
    port_->serve(device_);
    EXPECT_TRUE(run_until(io_, [&] { return !port_->connected(); }));
    ScannerWire third = connect();
    third.write("QT\n");
    EXPECT_EQ(received(third, "\n\n"), "QT\n00P\n\n");
}

TEST_F(LineStateTest, SplitsSoThatPiecesAreReadOneByOne) {
    ScannerWire wire = connect();
    port_->set_line({.link = {.split_at = {2}, .split_pause = 5ms}});
    wire.write("QT\n");
    EXPECT_EQ(received(wire, "QT"), "QT");
    EXPECT_EQ(received_by_now(wire), "");
    clock_.advance_to(5ms);
    EXPECT_EQ(received(wire, "\n\n"), "\n00P\n\n");
}

TEST_F(LineStateTest, HoldsEverythingBackWhileItStalls) {
    ScannerWire wire = connect();
    port_->set_line({.stalled = true});
    wire.write("BM\n");
    EXPECT_EQ(received_by_now(wire), "");
    EXPECT_TRUE(device_.state().laser_on());  // requests arrive
    wire.write("QT\n");
    EXPECT_EQ(received_by_now(wire), "");
    port_->set_line({});
    EXPECT_EQ(received(wire, "QT\n00P\n\n"), "BM\n00P\n\nQT\n00P\n\n");
}

TEST_F(LineStateTest, LosesScansWhileItStallsForLong) {
    ScannerWire wire = connect();
    wire.write("MD0000108000000\n");
    EXPECT_EQ(received(wire, "\n\n"), "MD0000108000000\n00P\n\n");
    port_->set_line({.stalled = true});
    std::int64_t revolution = device_.next_revolution();
    for (int i = 0; i < 100; ++i)
        device_.turn_complete(revolution++);
    EXPECT_EQ(received_by_now(wire), "");
    // 3.4 kB each, in 256 KiB.
    EXPECT_NEAR(static_cast<double>(port_->lost_scans()), 100 - 262144.0 / 3360, 3.0);
}

TEST_F(LineStateTest, LosesWhatIsSentEitherWayWhileItIsDead) {
    ScannerWire wire = connect();
    wire.write("MD0540054000000\n");
    EXPECT_EQ(received(wire, "\n\n"), "MD0540054000000\n00P\n\n");
    port_->set_line({.dead = true});
    wire.write("QT\n");
    const std::int64_t revolution = device_.next_revolution();
    device_.turn_complete(revolution);
    EXPECT_EQ(received_by_now(wire), "");
    EXPECT_TRUE(port_->connected());
    port_->set_line({});
    EXPECT_EQ(received_by_now(wire), "");
    EXPECT_TRUE(device_.wanted());  // QT was lost
    device_.turn_complete(revolution + 1);
    EXPECT_EQ(received(wire, "\n\n").rfind("MD0540054000000\n99b\n", 0), 0U);
}

TEST_F(LineStateTest, ShowsItsHookEachMessageAndEachClient) {
    RecordingHook hook;
    port_->set_hook(&hook);
    ScannerWire wire = connect();
    ASSERT_EQ(hook.ports.size(), 1U);
    EXPECT_EQ(hook.ports.front(), port_.get());
    wire.write("QT;aXb\nQT;L\nQT;X\n");
    EXPECT_EQ(received(wire, "QT;Y\n00P\n\n"), "QT;aYb\n00P\n\nQT;Y\n00P\n\n");
    EXPECT_EQ(hook.left,
              (std::vector<std::string>{"QT;aXb\n00P\n\n", "QT;L\n00P\n\n", "QT;X\n00P\n\n"}));
    port_->set_hook(nullptr);
    wire.write("QT;X\n");
    EXPECT_EQ(received(wire, "\n\n"), "QT;X\n00P\n\n");
    EXPECT_EQ(hook.left.size(), 3U);
}

TEST_F(LineStateTest, SendsRawBytesBehindWhatWasSent) {
    port_->send_raw("nobody");
    ScannerWire wire = connect();
    port_->set_line({.link = {.coalesce = 10ms}});
    wire.write("QT\n");
    EXPECT_EQ(received_by_now(wire), "");
    port_->send_raw(std::string("\0\1", 2));
    EXPECT_EQ(received_by_now(wire), "");
    clock_.advance_to(10ms);
    EXPECT_EQ(received(wire, "\1"), std::string("QT\n00P\n\n\0\1", 10));
}

}  // namespace
}  // namespace scipd::daemon
