// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What those who read along over /wire are told, of a scanner that a client on TCP talks to.
#include "daemon/api/wire_stream.h"

#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "daemon/clock/wall_clock.h"
#include "daemon/device/device.h"
#include "daemon/link/tcp_port.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/scanner_wire.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using tests::ScannerWire;

/// Reads what it is told when it is asked to.
class Reader : public WebSocket {
  public:
    Reader(WireStream& stream, const std::string& sensor) : talk_(stream.open(sensor, *this)) {}

    void send(std::shared_ptr<const std::string> message) override {
        unread_.push_back(json::parse(*message));
    }
    void send_bytes(std::shared_ptr<const std::string>) override {}
    void cut() override {}

    std::vector<json> read() {
        for (std::size_t i = 0; i < unread_.size(); ++i)
            talk_->left();
        return std::exchange(unread_, {});
    }

  private:
    std::vector<json> unread_;
    std::unique_ptr<Conversation> talk_;
};

/// The stream's own thread, when it has something else to do.
class BusyThread {
  public:
    WireStream::Ways ways() {
        return {.to_stream = [this](auto call) {
            is_busy ? waiting.push_back(std::move(call)) : call();
        }};
    }
    void go_on() {
        is_busy = false;
        for (const auto& call : std::exchange(waiting, {}))
            call();
    }

    bool is_busy = false;
    std::vector<WireStream::Ways::Call> waiting;
};

class WireStreamTest : public testing::Test {
  protected:
    WireStreamTest() { port_->serve(device_); }
    ~WireStreamTest() override {
        port_->stop();
        io_.restart();
        io_.run_for(10ms);
    }

    /// Asks for the version so often, and waits for all answers.
    void ask(int times) {
        for (int i = 0; i < times; ++i) {
            wire_.write("VV\n");
            std::string answer;
            ASSERT_TRUE(run_until(io_, [&] {
                std::array<char, 1024> buffer;
                answer.append(buffer.data(), wire_.read(buffer, 0ms));
                return answer.ends_with("\n\n");
            }));
        }
    }
    [[nodiscard]] ScannerWire connect() const {
        return ScannerWire::tcp(tests::port_of(port_->address()));
    }

    boost::asio::io_context io_;
    WallClock clock_{io_.get_executor()};
    World world_ = wall_world();
    Device device_{"robot", ideal_sensor(), 1, world_, clock_};
    std::shared_ptr<TcpPort> port_ =
        std::make_shared<TcpPort>(io_.get_executor(), Address{"127.0.0.1", 0});
    BusyThread thread_;
    WireStream stream_{thread_.ways()};
    WireStream::Tap tap_{
        stream_, "robot/scanner",
        std::make_unique<WireTap>(device_, std::vector<std::shared_ptr<Port>>{port_})};
    ScannerWire wire_ = connect();
};

TEST_F(WireStreamTest, TellsThoseWhoReadAlong) {
    Reader reader(stream_, "robot/scanner");
    Reader of_other(stream_, "robot/other");
    ask(1);
    const auto told = reader.read();
    ASSERT_EQ(told.size(), 2U);
    EXPECT_EQ(told[0]["from"], "client");
    EXPECT_EQ(told[0]["line"], "VV");
    EXPECT_EQ(told[0]["means"], "requests the version");
    EXPECT_EQ(told[0]["status"], nullptr);
    EXPECT_EQ(told[1]["from"], "scanner");
    EXPECT_EQ(told[1]["status"], "00");
    EXPECT_EQ(told[1]["explains"], "carried out");
    EXPECT_FALSE(told[1].contains("dropped"));
    EXPECT_TRUE(of_other.read().empty());
}

TEST_F(WireStreamTest, TellsHowManyMessagesASlowReaderHasMissed) {
    Reader reader(stream_, "robot/scanner");
    ask(50);
    const std::size_t had = reader.read().size();
    EXPECT_LT(had, 100U) << "nothing waits for it without end";
    ask(1);
    const auto told = reader.read();
    ASSERT_EQ(told.size(), 2U);
    EXPECT_EQ(told[0]["dropped"], 100 - had);
    EXPECT_FALSE(told[1].contains("dropped"));
}

TEST_F(WireStreamTest, TellsHowManyMessagesItHasMissedItself) {
    Reader reader(stream_, "robot/scanner");
    thread_.is_busy = true;
    ask(300);
    const std::size_t kept = thread_.waiting.size();
    EXPECT_LT(kept, 600U) << "nothing waits without end";
    thread_.go_on();
    const std::size_t had = reader.read().size();
    ask(1);
    EXPECT_EQ(reader.read().at(0)["dropped"], 600 - had);
}

TEST_F(WireStreamTest, ListensOnlyWhileSomebodyReads) {
    EXPECT_EQ(port_->ear(), nullptr);
    {
        Reader reader(stream_, "robot/scanner");
        EXPECT_NE(port_->ear(), nullptr);
        Reader second(stream_, "robot/scanner");
    }
    EXPECT_EQ(port_->ear(), nullptr);
}

}  // namespace
}  // namespace scipd::daemon
