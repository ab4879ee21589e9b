// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/connection.h"

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "daemon/clock/wall_clock.h"
#include "daemon/device/device.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

class ConnectionTest : public testing::Test {
  protected:
    ConnectionTest() {
        std::array<int, 2> ends{};
        EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends.data()), 0);
        client_ = ends[0];
        scanner_ = ends[1];
        connection_ = std::make_shared<Connection>(
            Connection::Descriptor(io_, ends[1]), device_, LinkConfig{},
            Connection::Hooks{.somebody_there = [this] { return somebody_there_; },
                              .ended = [this](Leaving) { ++ended_; }});
        connection_->start();
    }
    ~ConnectionTest() override {
        connection_->close();
        io_.restart();
        io_.run_for(10ms);
        if (client_ >= 0) ::close(client_);
    }

    void write(std::string_view bytes) const {
        EXPECT_EQ(::send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL),
                  static_cast<ssize_t>(bytes.size()));
    }

    /// What has come so far.
    const std::string& read() {
        std::array<char, 4096> buffer;
        for (ssize_t count = 1; count > 0;) {
            count = ::recv(client_, buffer.data(), buffer.size(), 0);
            if (count > 0) received_.append(buffer.data(), static_cast<std::size_t>(count));
        }
        return received_;
    }

    bool comes(const std::string& text) {
        return run_until(io_, [&] { return read() == text; });
    }

    void close_client() { ::close(std::exchange(client_, -1)); }

    boost::asio::io_context io_;
    WallClock clock_{io_.get_executor()};
    World world_ = wall_world();
    Device device_{"robot", ideal_sensor(), 1, world_, clock_};
    bool somebody_there_ = true;
    int ended_ = 0;
    int client_ = -1;
    int scanner_ = -1;  ///< the other end, which the connection has
    std::string received_;
    std::shared_ptr<Connection> connection_;
};

TEST_F(ConnectionTest, AnswersRequestsInWhateverPiecesTheyCome) {
    write("B");
    io_.run_for(20ms);
    write("M\nQT\nT");
    EXPECT_TRUE(comes("BM\n00P\n\nQT\n00P\n\n"));
    write("M0\n");
    EXPECT_TRUE(comes("BM\n00P\n\nQT\n00P\n\nTM0\n00P\n\n"));
    EXPECT_EQ(ended_, 0);
}

TEST_F(ConnectionTest, TakesAnyNumberOfRequestsAtOnce) {
    std::string requests;
    std::string answers;
    for (int i = 0; i < 1000; ++i) {
        requests += "QT\n";
        answers += "QT\n00P\n\n";
    }
    write(requests);
    EXPECT_TRUE(comes(answers));
}

TEST_F(ConnectionTest, AnswersWhatWasAskedBeforeItEnds) {
    write("QT\n");
    ::shutdown(client_, SHUT_WR);
    EXPECT_TRUE(run_until(io_, [&] { return ended_ == 1; }));
    EXPECT_EQ(read(), "QT\n00P\n\n");
    EXPECT_EQ(device_.clients(), 0U);
}

TEST_F(ConnectionTest, EndsOnceAndTakesItsStreamWithIt) {
    write("MD0540054000000\n");
    EXPECT_TRUE(comes("MD0540054000000\n00P\n\n"));
    EXPECT_TRUE(device_.wanted());
    close_client();
    EXPECT_TRUE(run_until(io_, [&] { return ended_ == 1; }));
    EXPECT_FALSE(device_.wanted());
    io_.restart();
    io_.run_for(50ms);
    EXPECT_EQ(ended_, 1);
}

TEST_F(ConnectionTest, DoesNotCallBackOnceClosed) {
    connection_->close();
    close_client();
    io_.run_for(50ms);
    EXPECT_EQ(ended_, 0);
    EXPECT_EQ(device_.clients(), 0U);
}

TEST_F(ConnectionTest, HearsAndSaysNothingWhileNobodyIsThere) {
    somebody_there_ = false;
    write("QT\n");
    io_.run_for(50ms);
    EXPECT_EQ(read(), "");
    somebody_there_ = true;
    write("TM0\n");
    EXPECT_TRUE(comes("TM0\n00P\n\n"));
}

TEST_F(ConnectionTest, LosesScansThatDoNotFitAndNoReply) {
    write("MD0000108000000\n");
    EXPECT_TRUE(comes("MD0000108000000\n00P\n\n"));
    std::int64_t revolution = device_.next_revolution();
    // Nobody reads; the kernel holds some and the outbox some.
    for (int i = 0; i < 2000 && connection_->lost() < 5; ++i) {
        device_.turn_complete(revolution++);
        io_.restart();
        io_.poll();
    }
    ASSERT_GE(connection_->lost(), 5U);
    const std::uint64_t sent = device_.counts().scans;

    write("QT\n");
    EXPECT_TRUE(run_until(io_, [&] { return read().ends_with("QT\n00P\n\n"); }));
    std::uint64_t scans = 0;
    for (std::size_t at = 0; (at = read().find("MD0000108000000\n99b\n", at)) != std::string::npos;
         ++at)
        ++scans;
    EXPECT_EQ(scans + connection_->lost(), sent);
}

TEST_F(ConnectionTest, ForgetsWhatWaitsToBeSent) {
    write("MD0000108000000\n");
    EXPECT_TRUE(comes("MD0000108000000\n00P\n\n"));
    std::int64_t revolution = device_.next_revolution();
    for (int i = 0; i < 2000 && connection_->lost() == 0; ++i) {
        device_.turn_complete(revolution++);
        io_.restart();
        io_.poll();
    }
    ASSERT_GT(connection_->lost(), 0U);
    connection_->forget();
    io_.restart();
    io_.poll();
    // What the kernel has is out of reach; nothing follows it, though there is room again.
    const std::size_t held = read().size();
    io_.restart();
    io_.run_for(50ms);
    EXPECT_EQ(read().size(), held);
    // And the next message is whole.
    write("QT\n");
    EXPECT_TRUE(run_until(io_, [&] { return read().size() > held; }));
    EXPECT_EQ(read().substr(held), "QT\n00P\n\n");
}

TEST_F(ConnectionTest, ForgetsTheRestOfAMessageOfWhichAPartHasJustBeenWritten) {
    const int smallest = 1;  // that the kernel has, which is less than a scan
    ASSERT_EQ(::setsockopt(scanner_, SOL_SOCKET, SO_SNDBUF, &smallest, sizeof(smallest)), 0);
    write("ME0000108000000\n");
    EXPECT_TRUE(comes("ME0000108000000\n00P\n\n"));
    io_.restart();
    io_.poll();
    device_.turn_complete(device_.next_revolution() + 1);
    connection_->forget();
    const std::size_t held = read().size();
    ASSERT_FALSE(received_.ends_with("\n\n")) << "it was written whole";
    write("QT\n");
    EXPECT_TRUE(run_until(io_, [&] { return read().size() > held; }));
    EXPECT_EQ(read().substr(held), "QT\n00P\n\n");
}

}  // namespace
}  // namespace scipd::daemon
