// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is told of a conversation, against what a client on TCP has said and read.
#include "daemon/wire/wire_tap.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/clock/wall_clock.h"
#include "daemon/device/device.h"
#include "daemon/device/scan_loop.h"
#include "daemon/link/tcp_port.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/scanner_wire.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using tests::ScannerWire;

class WireTapTest : public testing::Test {
  protected:
    WireTapTest() { port_->serve(device_); }
    ~WireTapTest() override {
        port_->stop();
        io_.restart();
        io_.run_for(10ms);
    }

    [[nodiscard]] ScannerWire connect() const {
        return ScannerWire::tcp(tests::port_of(port_->address()));
    }
    /// Says this, and reads until that has come.
    std::string ask(ScannerWire& wire, const std::string& request, const std::string& until) {
        wire.write(request);
        std::string received;
        EXPECT_TRUE(run_until(io_, [&] {
            std::array<char, 8192> buffer;
            received.append(buffer.data(), wire.read(buffer, 0ms));
            return received.find(until) != std::string::npos && received.ends_with("\n\n");
        })) << received;
        return received;
    }
    void listen() {
        tap_.listen([this](WireEntry entry) { told_.push_back(std::move(entry)); });
    }

    boost::asio::io_context io_;
    WallClock clock_{io_.get_executor()};
    World world_ = wall_world();
    Device device_{"robot", ideal_sensor(), 1, world_, clock_};
    ScanLoop loop_{device_, clock_};
    std::shared_ptr<TcpPort> port_ =
        std::make_shared<TcpPort>(io_.get_executor(), Address{"127.0.0.1", 0});
    std::vector<WireEntry> told_;
    WireTap tap_{device_, {port_}};
};

TEST_F(WireTapTest, TellsRequestsAndReplies) {
    listen();
    ScannerWire wire = connect();
    const std::string answer = ask(wire, "BM;hello\nBM\n", "BM\n02");
    ASSERT_EQ(told_.size(), 4U);
    EXPECT_TRUE(told_[0].from_client);
    EXPECT_EQ(told_[0].line, "BM;hello");
    EXPECT_EQ(told_[0].client, "tcp");
    EXPECT_EQ(told_[0].status, "");
    EXPECT_EQ(told_[2].line, "BM;hello");
    EXPECT_FALSE(told_[2].from_client);
    EXPECT_EQ(told_[2].status, "00");
    EXPECT_EQ(told_[3].status, "02");
    EXPECT_EQ(told_[3].explains, "the laser is on already");
    EXPECT_EQ(told_[2].bytes + told_[3].bytes, answer.size());
}

TEST_F(WireTapTest, IsToldToALogInOneLine) {
    listen();
    ScannerWire wire = connect();
    (void)ask(wire, "BM;hello\nBM\n", "BM\n02");
    ASSERT_EQ(told_.size(), 4U);
    EXPECT_EQ(line_of(told_[0]), "tcp hears BM;hello: " + told_[0].means);
    EXPECT_EQ(line_of(told_[3]), "tcp answers BM with 02: the laser is on already");
}

TEST_F(WireTapTest, TellsTheScansOfAStream) {
    listen();
    ScannerWire wire = connect();
    const std::string answer = ask(wire, "MD0000108001002\n", "MD0000108001000\n99");
    ASSERT_EQ(told_.size(), 4U);
    EXPECT_EQ(told_[0].means, "requests 2 scans of distances, steps 0 to 1080");
    EXPECT_EQ(told_[1].means, "the stream begins");
    EXPECT_FALSE(told_[1].scan);
    for (std::size_t i : {2U, 3U})
        EXPECT_EQ(told_[i].status, "99");
    ASSERT_TRUE(told_[2].scan && told_[3].scan);
    EXPECT_EQ(*told_[3].scan, *told_[2].scan + 1);
    EXPECT_EQ(told_[3].scan, device_.latest_scan()->revolution);
}

TEST_F(WireTapTest, TellsNothingWhereNobodyListens) {
    ScannerWire wire = connect();
    ask(wire, "VV\n", "VV\n00");
    EXPECT_THAT(told_, IsEmpty());
    listen();
    ask(wire, "VV\n", "VV\n00");
    EXPECT_EQ(told_.size(), 2U) << "of a client that was there before";
    tap_.listen(nullptr);
    ask(wire, "VV\n", "VV\n00");
    EXPECT_EQ(told_.size(), 2U);
    EXPECT_EQ(port_->ear(), nullptr);
}

TEST_F(WireTapTest, LeavesThePortToWhoeverListensThereNext) {
    listen();
    std::vector<WireEntry> told_to_next;
    Device next{"robot", ideal_sensor("UTM-30LX"), 1, world_, clock_};
    WireTap tap_of_next{next, {port_}};
    tap_of_next.listen([&](WireEntry entry) { told_to_next.push_back(std::move(entry)); });
    tap_.listen(nullptr);
    port_->serve(next);
    ScannerWire wire = connect();
    ask(wire, "VV\n", "VV\n00");
    EXPECT_EQ(told_to_next.size(), 2U);
    tap_of_next.listen(nullptr);
    port_->stop();
}

TEST_F(WireTapTest, TellsScip1) {
    SensorConfig config = ideal_sensor("URG-04LX");
    config.power_up = PowerUp::scip1;
    Device old{"robot", config, 1, world_, clock_};
    ScanLoop loop{old, clock_};
    WireTap tap{old, {port_}};
    port_->serve(old);
    tap.listen([this](WireEntry entry) { told_.push_back(std::move(entry)); });
    ScannerWire wire = connect();
    ask(wire, "V\n", "V\n0\n");
    ask(wire, "L0\nG04472501\n", "G04472501\nE\n");
    ask(wire, "L1\nG04472501\n", "G04472501\n0\n");
    ask(wire, "SCIP2.0\n", "SCIP2.0\n0\n");
    ask(wire, "V\n", "V\n0E");
    std::vector<std::array<std::string, 4>> replies;
    for (const WireEntry& entry : told_) {
        if (!entry.from_client)
            replies.push_back({entry.line, entry.status, entry.means, entry.explains});
    }
    using Reply = std::array<std::string, 4>;
    EXPECT_THAT(replies,
                testing::ElementsAre(
                    Reply{"V", "0", "returns the version", "carried out"},
                    Reply{"L0", "0", "the laser is off", "carried out"},
                    Reply{"G04472501", "E", "not carried out",
                          "the scanner does not know the request, or its laser is off"},
                    Reply{"L1", "0", "the laser is on", "carried out"},
                    Reply{"G04472501", "0", "the requested scan", "carried out"},
                    Reply{"SCIP2.0", "0", "SCIP 2.0 is spoken", "carried out"},
                    Reply{"V", "0E", "not carried out",
                          "the scanner does not know the command, or is in time-adjust mode"}));
    EXPECT_EQ(told_[3].means, "requests one scan, steps 44 to 725, in SCIP 1.1");
    tap.listen(nullptr);
    port_->stop();
}

TEST_F(WireTapTest, ShowsWhatFaultsHaveMadeOfAMessage) {
    struct Spoiler : LineHook {
        void leaving(protocol::Send& message) override { message.bytes[1] = '\x07'; }
        void connected(Port&) override {}
    } spoiler;
    listen();
    port_->set_hook(&spoiler);
    ScannerWire wire = connect();
    ask(wire, "VV\n", "00P");
    ASSERT_EQ(told_.size(), 2U);
    EXPECT_EQ(told_[1].line, "V\\x07");
    EXPECT_EQ(told_[1].means, "not carried out");
    port_->set_hook(nullptr);
}

}  // namespace
}  // namespace scipd::daemon
