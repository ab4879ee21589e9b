// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A connection over links that take their time, cut and join: on a clock that is stepped by hand
// and with a socket that keeps every write apart, so that instants and writes are exact.
#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "daemon/clock/stepped_clock.h"
#include "daemon/device/device.h"
#include "daemon/link/connection.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;
using Writes = std::vector<std::string>;

class ConnectionLink : public testing::Test {
  protected:
    ~ConnectionLink() override {
        if (connection_) connection_->close();
        turn();
        ::close(client_);
    }

    void connect(const LinkConfig& link, const std::string& model = "UST-10LX") {
        SensorConfig config = ideal_sensor(model);
        config.link = link;
        device_ = std::make_unique<Device>("robot", config, 1, world_, clock_);
        std::array<int, 2> ends{};
        ASSERT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, ends.data()), 0);
        client_ = ends[0];
        connection_ = std::make_shared<Connection>(
            Connection::Descriptor(io_, ends[1]), *device_, link,
            Connection::Hooks{
                .client_rate = [this] { return client_rate_; },
                .kind = link.baud ? protocol::LinkKind::tty : protocol::LinkKind::network,
                .ended = [this](Leaving) { ++ended_; }});
        connection_->start();
    }

    void turn() {
        io_.restart();
        io_.poll();
    }

    void write(std::string_view bytes) {
        ASSERT_EQ(::send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL),
                  static_cast<ssize_t>(bytes.size()));
        turn();
    }

    /// What has been written since the last time, one string for each write.
    Writes writes() {
        Writes all;
        std::array<char, 8192> buffer;
        for (;;) {
            turn();
            const ssize_t count = ::recv(client_, buffer.data(), buffer.size(), 0);
            if (count <= 0) return all;
            all.emplace_back(buffer.data(), static_cast<std::size_t>(count));
        }
    }

    Writes writes_until(sim::Time time) {
        clock_.advance_to(time);
        return writes();
    }

    /// In steps of a tenth of a millisecond.
    std::string bytes_until(sim::Time end) {
        std::string bytes;
        while (clock_.now() < end) {
            for (const std::string& part : writes_until(clock_.now() + 100us))
                bytes += part;
        }
        return bytes;
    }

    boost::asio::io_context io_;
    SteppedClock clock_;
    World world_ = wall_world();
    std::unique_ptr<Device> device_;
    int client_ = -1;
    int client_rate_ = 0;
    int ended_ = 0;
    std::shared_ptr<Connection> connection_;
};

TEST_F(ConnectionLink, WritesEachMessageAtOnceAndWholeWhereNothingIsBetween) {
    connect({});
    write("QT\nTM0\n");
    EXPECT_THAT(writes(), ElementsAre("QT\n00P\n\n", "TM0\n00P\n\n"));
    EXPECT_EQ(clock_.now(), 0ms);
}

TEST_F(ConnectionLink, TakesItsTimeEachWay) {
    connect({.latency = 10ms});
    write("QT\n");
    EXPECT_THAT(writes_until(5ms), IsEmpty());
    write("TM0\n");
    EXPECT_THAT(writes_until(20ms - 1ns), IsEmpty());
    EXPECT_THAT(writes_until(20ms), ElementsAre("QT\n00P\n\n"));
    EXPECT_THAT(writes_until(25ms - 1ns), IsEmpty());
    EXPECT_THAT(writes_until(25ms), ElementsAre("TM0\n00P\n\n"));
}

TEST_F(ConnectionLink, KeepsEveryMessageAndTheirOrderHoweverMuchItVaries) {
    connect({.latency = 5ms, .jitter = 5ms});
    std::string asked;
    std::string answers;
    for (int i = 0; i < 100; ++i) {
        const std::string request = "QT;" + std::to_string(i);
        write(request + "\n");
        answers += request + "\n00P\n\n";
        asked += bytes_until(clock_.now() + 1ms);
    }
    asked += bytes_until(clock_.now() + 30ms);
    EXPECT_EQ(asked, answers);
}

TEST_F(ConnectionLink, WritesAtOnceWhatIsSentWithinAMoment) {
    connect({.coalesce = 5ms});
    write("QT\n");
    (void)writes_until(3ms);
    write("TM0\n");
    EXPECT_THAT(writes_until(5ms - 1ns), IsEmpty());
    EXPECT_THAT(writes_until(5ms), ElementsAre("QT\n00P\n\nTM0\n00P\n\n"));
}

TEST_F(ConnectionLink, WritesPieceByPiece) {
    connect({.split_bytes = 3});
    write("QT\n");
    EXPECT_THAT(writes(), ElementsAre("QT\n", "00P", "\n\n"));
}

TEST_F(ConnectionLink, AnswersWhatIsUnderWayWhenItsClientHasGone) {
    connect({.latency = 10ms});
    write("QT\n");
    ::shutdown(client_, SHUT_WR);
    turn();
    EXPECT_THAT(writes_until(20ms - 1ns), IsEmpty());
    EXPECT_EQ(ended_, 0);
    EXPECT_THAT(writes_until(20ms), ElementsAre("QT\n00P\n\n"));
    EXPECT_EQ(ended_, 1);
}

TEST_F(ConnectionLink, GivesNoStreamToAClientThatHasGone) {
    connect({.latency = 10ms});
    write("MD0540054000000\n");
    ::shutdown(client_, SHUT_WR);
    turn();
    (void)writes_until(10ms);
    EXPECT_EQ(ended_, 1);
    EXPECT_FALSE(device_->wanted());
}

TEST_F(ConnectionLink, ForgetsWhatIsUnderWay) {
    connect({.latency = 10ms});
    write("QT\n");
    EXPECT_THAT(writes_until(15ms), IsEmpty());
    write("TM0\n");
    connection_->forget();
    write("BM\n");
    EXPECT_EQ(bytes_until(50ms), "BM\n00P\n\n");
    EXPECT_FALSE(device_->state().adjusting());
}

TEST_F(ConnectionLink, ForgetsARequestThatWaitsAndHalfOfOne) {
    connect({});
    write("BM\nGD0540054000\n");
    EXPECT_THAT(writes(), ElementsAre("BM\n00P\n\n"));
    write("TM");
    connection_->forget();
    write("QT\n");
    EXPECT_THAT(writes(), ElementsAre("QT\n00P\n\n"));
    clock_.advance_to(100ms);
    device_->turn_complete(device_->next_revolution());
    EXPECT_THAT(writes(), IsEmpty());
}

TEST_F(ConnectionLink, EndsWhatItsClientBeganWhenThatHangsUp) {
    connect({.latency = 10ms});
    write("MD0540054000000\n");
    (void)writes_until(20ms);
    EXPECT_TRUE(device_->wanted());
    write("QT\n");
    connection_->hang_up();
    EXPECT_FALSE(device_->wanted());
    EXPECT_FALSE(device_->state().laser_on());
    EXPECT_THAT(writes_until(50ms), IsEmpty());
    // And the next client is served.
    write("BM\n");
    EXPECT_THAT(writes_until(70ms), ElementsAre("BM\n00P\n\n"));
}

TEST_F(ConnectionLink, LosesScansForWhatIsUnderWay) {
    connect({.latency = 1h});
    write("MD0000108000000\n");
    clock_.advance_to(1h);
    std::int64_t revolution = device_->next_revolution();
    while (connection_->lost() == 0 && revolution < device_->next_revolution() + 1000) {
        device_->turn_complete(revolution++);
        turn();
    }
    EXPECT_EQ(connection_->lost(), 1U);
    // 3.4 kB each, in 256 KiB.
    EXPECT_NEAR(static_cast<double>(device_->counts().scans), 262144.0 / 3360, 3.0);
}

class SerialLine : public ConnectionLink {
  protected:
    void connect_at(int rate, const std::string& model = "URG-04LX") {
        client_rate_ = rate;
        connect({.baud = rate}, model);
    }
};

constexpr sim::Time byte_time = sim::Time(1s) / 1920;  // at 19200

TEST_F(SerialLine, TakesTenBitsForAByteEachWay) {
    connect_at(19200);
    write("QT\n");
    const sim::Time asked = 3 * byte_time;
    EXPECT_THAT(writes_until(asked + byte_time - 1us), IsEmpty());
    EXPECT_THAT(writes_until(asked + byte_time + 1us), ElementsAre("Q"));
    EXPECT_THAT(writes_until(asked + 2 * byte_time - 1us), IsEmpty());
    EXPECT_THAT(writes_until(asked + 2 * byte_time + 1us), ElementsAre("T"));
    // What is late leaves without delay.
    EXPECT_THAT(writes_until(asked + 8 * byte_time - 1us), ElementsAre("\n", "0", "0", "P", "\n"));
    EXPECT_THAT(writes_until(asked + 8 * byte_time + 1us), ElementsAre("\n"));
}

TEST_F(SerialLine, SpeaksAndHearsAtItsOwnRateOnly) {
    connect_at(19200);
    client_rate_ = 115200;
    write("BM\n");
    const std::string noise = bytes_until(1s);
    EXPECT_EQ(noise.find("BM"), std::string::npos);
    EXPECT_FALSE(device_->state().laser_on());
    client_rate_ = 19200;
    write("\nBM\n");
    EXPECT_THAT(bytes_until(2s), testing::EndsWith("BM\n00P\n\n"));
    EXPECT_TRUE(device_->state().laser_on());
    client_rate_ = 38400;
    write("QT\n");
    (void)bytes_until(3s);
    EXPECT_TRUE(device_->state().laser_on());
}

// As MRPT does.
TEST_F(SerialLine, HearsARequestThatFollowsOneAtAHigherRate) {
    connect_at(19200);
    client_rate_ = 115200;
    write("QT\n");
    EXPECT_EQ(bytes_until(1s), "");
    client_rate_ = 19200;
    write("BM\n");
    EXPECT_EQ(bytes_until(2s), "BM\n00P\n\n");
}

TEST_F(SerialLine, ChangesItsRateAfterTheReply) {
    connect_at(19200);
    write("SS115200\n");
    EXPECT_EQ(bytes_until(15ms), "SS115200\n00P\n\n");
    // At the old rate nobody is heard any more.
    write("BM\n");
    (void)bytes_until(1s);
    EXPECT_FALSE(device_->state().laser_on());
    client_rate_ = 115200;
    write("\nII\n");
    EXPECT_THAT(bytes_until(2s), testing::HasSubstr("\nSBPS:115200[bps];"));
    write("RS\n");
    EXPECT_EQ(bytes_until(3s), "RS\n00P\n\n");
    client_rate_ = 19200;
    write("II\n");
    EXPECT_THAT(bytes_until(4s), testing::HasSubstr("\nSBPS:19200[bps]<-Default setting by user;"));
}

TEST_F(SerialLine, StaysAtTheOldRateUntilTheReplyIsThere) {
    connect_at(19200);
    write("SS115200\n");
    EXPECT_EQ(bytes_until(9 * byte_time + 6 * byte_time), "SS1152");
    // The reply is still on the line, at the old rate: this is heard, and answered at the new one.
    write("BM\n");
    EXPECT_THAT(bytes_until((9 + 14) * byte_time + 1ms), testing::StartsWith("00\n00P\n\n"));
    EXPECT_TRUE(device_->state().laser_on());
    EXPECT_EQ(bytes_until(1s).find("BM"), std::string::npos);
}

TEST_F(SerialLine, ChangesItsRateAlsoWhereTheReplyIsForgotten) {
    connect_at(19200);
    write("SS115200\n");
    EXPECT_EQ(bytes_until(11 * byte_time), "SS");
    connection_->forget();
    client_rate_ = 115200;
    write("\nBM\n");
    EXPECT_EQ(bytes_until(1s), "BM\n00P\n\n");
}

TEST_F(SerialLine, PowersUpAtTheRateThatItsUserHasSet) {
    connect_at(57600);
    write("II\n");
    EXPECT_THAT(bytes_until(1s), testing::HasSubstr("\nSBPS:57600[bps]<-Default setting by user;"));
    write("SS019200\n");
    EXPECT_EQ(bytes_until(2s), "SS019200\n00P\n\n");
    client_rate_ = 19200;
    write("RS\n");
    EXPECT_EQ(bytes_until(3s), "RS\n00P\n\n");
    client_rate_ = 57600;
    write("BM\n");
    EXPECT_EQ(bytes_until(4s), "BM\n00P\n\n");
}

TEST_F(SerialLine, LosesScansThatItIsTooSlowForAndAnswersSoon) {
    connect_at(19200);
    write("MS0000076801000\n");
    (void)bytes_until(30ms);
    std::int64_t revolution = device_->next_revolution();
    for (int i = 0; i < 100; ++i) {
        clock_.advance_to(device_->leaves(revolution));
        device_->turn_complete(revolution++);
        (void)writes();
    }
    // A scan of 769 steps at two characters has about 1600 bytes with its sums, at 1920 a second.
    EXPECT_NEAR(static_cast<double>(connection_->lost()), 100 - 10 * 1920.0 / 1600, 5);
    write("QT\n");
    const sim::Time asked = clock_.now();
    std::string bytes;
    while (!bytes.ends_with("QT\n00P\n\n") && clock_.now() < asked + 10s)
        bytes += bytes_until(clock_.now() + 10ms);
    EXPECT_LT(clock_.now() - asked, 3s);
}

TEST_F(SerialLine, RunsAtTheRateThatAnyClientSets) {
    connect_at(19200);
    const auto other = device_->connect([] {}, protocol::LinkKind::network);
    other->receive("SS115200\n");
    turn();
    write("BM\n");
    (void)bytes_until(1s);
    EXPECT_FALSE(device_->state().laser_on());
    client_rate_ = 115200;
    write("\nBM\n");
    EXPECT_THAT(bytes_until(2s), testing::EndsWith("BM\n00P\n\n"));
}

}  // namespace
}  // namespace scipd::daemon
