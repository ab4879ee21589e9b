// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Ports that cut off their clients, refuse them and come back, as the kernel tells clients.
#include <array>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include "daemon/clock/wall_clock.h"
#include "daemon/device/device.h"
#include "daemon/link/pty_port.h"
#include "daemon/link/tcp_port.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/scanner_wire.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using tests::ScannerWire;
namespace fs = std::filesystem;

/// A plain socket, so that nothing is between the kernel and the test.
class Client {
  public:
    explicit Client(const std::string& address)
        : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
        to.sin_port = ::htons(tests::port_of(address));
        const auto* const name = reinterpret_cast<const sockaddr*>(&to);
        refusal_ = ::connect(socket_, name, sizeof(to)) == 0 ? 0 : errno;
    }
    ~Client() { ::close(socket_); }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;

    /// The error of connect(); 0: it is connected.
    [[nodiscard]] int refusal() const { return refusal_; }
    void write(const std::string& bytes) const {
        EXPECT_EQ(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL),
                  static_cast<ssize_t>(bytes.size()));
    }
    /// The end of the connection: 0 for FIN, else the error. -1: it has not ended.
    int end() {
        std::array<char, 1024> buffer;
        const ssize_t count = ::recv(socket_, buffer.data(), buffer.size(), MSG_DONTWAIT);
        if (count == 0) return 0;
        if (count < 0) return errno == EAGAIN ? -1 : errno;
        received_.append(buffer.data(), static_cast<std::size_t>(count));
        return -1;
    }
    [[nodiscard]] const std::string& received() const { return received_; }

  private:
    int socket_;
    int refusal_ = 0;
    std::string received_;
};

class TcpCutTest : public testing::Test {
  protected:
    TcpCutTest() { port_->serve(device_); }
    ~TcpCutTest() override {
        port_->stop();
        io_.restart();
        io_.run_for(10ms);
    }

    std::unique_ptr<Client> connect() {
        auto client = std::make_unique<Client>(port_->address());
        EXPECT_EQ(client->refusal(), 0);
        EXPECT_TRUE(is_answered(*client));
        return client;
    }
    bool is_answered(Client& client) {
        client.write("QT\n");
        const std::string all = client.received() + "QT\n00P\n\n";
        return run_until(io_, [&] {
            EXPECT_EQ(client.end(), -1);
            return client.received() == all;
        });
    }
    int end_of(Client& client) {
        int end = -1;
        EXPECT_TRUE(run_until(io_, [&] { return (end = client.end()) != -1; }));
        return end;
    }

    boost::asio::io_context io_;
    WallClock clock_{io_.get_executor()};
    World world_ = wall_world();
    Device device_{"robot", ideal_sensor(), 1, world_, clock_};
    std::shared_ptr<TcpPort> port_ =
        std::make_shared<TcpPort>(io_.get_executor(), Address{"127.0.0.1", 0});
};

TEST_F(TcpCutTest, EndsAConnectionWithFinAndTakesTheNextClient) {
    const auto client = connect();
    client->write("half a request");  // which nobody reads
    port_->cut(Cut::fin);
    EXPECT_EQ(end_of(*client), 0);
    EXPECT_EQ(device_.clients(), 0U);
    (void)connect();
}

TEST_F(TcpCutTest, EndsAConnectionWithAResetAndTakesTheNextClient) {
    const auto client = connect();
    port_->cut(Cut::rst);
    EXPECT_EQ(end_of(*client), ECONNRESET);
    EXPECT_EQ(device_.clients(), 0U);
    (void)connect();
}

TEST_F(TcpCutTest, SendsNothingMoreOnceItIsCut) {
    const auto client = connect();
    port_->cut(Cut::fin);
    port_->set_line({});  // brings nobody back
    client->write("VV\n");
    const std::string before = client->received();
    (void)end_of(*client);
    EXPECT_EQ(client->received(), before);
}

TEST_F(TcpCutTest, CutsNobodyWhereNobodyIs) {
    port_->cut(Cut::rst);
    (void)connect();
}

TEST_F(TcpCutTest, RefusesWhoConnectsAndKeepsWhoIsConnected) {
    const auto first = connect();
    const std::string address = port_->address();
    port_->set_line({.refuses = true});
    EXPECT_EQ(Client(address).refusal(), ECONNREFUSED);
    EXPECT_EQ(port_->address(), address);
    EXPECT_TRUE(is_answered(*first));
    port_->cut(Cut::rst);
    EXPECT_EQ(end_of(*first), ECONNRESET);
    EXPECT_EQ(Client(address).refusal(), ECONNREFUSED);

    port_->set_line({});
    EXPECT_EQ(port_->address(), address);
    (void)connect();
}

TEST_F(TcpCutTest, ListensAgainInTheSameTurn) {
    port_->set_line({.refuses = true});
    port_->set_line({});
    (void)connect();
}

TEST_F(TcpCutTest, WaitsForAPortThatSomebodyElseHasTaken) {
    const std::string address = port_->address();
    port_->set_line({.refuses = true});
    const Address taken{"127.0.0.1", static_cast<std::uint16_t>(std::stoul(address.substr(10)))};
    auto other = std::make_shared<TcpPort>(io_.get_executor(), taken);
    port_->set_line({});
    io_.restart();
    io_.run_for(150ms);
    other->stop();
    EXPECT_TRUE(run_until(io_, [&] { return Client(address).refusal() == 0; }));
}

TEST_F(TcpCutTest, ServesAgainAndStopsWhileItRefuses) {
    port_->set_line({.refuses = true});
    port_->serve(device_);
    (void)connect();
    const std::string address = port_->address();
    port_->set_line({.refuses = true});
    port_->stop();
    port_->set_line({});
    EXPECT_EQ(Client(address).refusal(), ECONNREFUSED);
}

class TtyCutTest : public testing::Test {
  protected:
    TtyCutTest() { port_->serve(device_); }
    ~TtyCutTest() override {
        port_->stop();
        turn();
    }

    void turn() {
        io_.restart();
        io_.run_for(10ms);
    }

    [[nodiscard]] bool has_name() const { return fs::exists(fs::symlink_status(link_)); }
    void unplug() {
        port_->set_line({.hung_up = true});
        EXPECT_TRUE(run_until(io_, [&] { return !has_name(); }));
    }

    bool is_answered(ScannerWire& wire) {
        wire.write("QT\n");
        std::string received;
        return run_until(io_, [&] {
            std::array<char, 1024> buffer;
            received.append(buffer.data(), wire.read(buffer, 0ms));
            return received == "QT\n00P\n\n";
        });
    }

    bool is_hung_up(const ScannerWire& wire) {
        const bool told = run_until(io_, [&] {
            pollfd state{.fd = wire.descriptor(), .events = POLLIN, .revents = 0};
            return ::poll(&state, 1, 0) == 1 && (state.revents & POLLHUP) != 0;
        });
        return told && ::write(wire.descriptor(), "Q", 1) == -1 && errno == EIO;
    }

    boost::asio::io_context io_;
    WallClock clock_{io_.get_executor()};
    World world_ = wall_world();
    Device device_{"robot", ideal_sensor(), 1, world_, clock_};
    tests::TempDir directory_;
    tests::Warnings log_;
    fs::path link_ = directory_.path() / "tty";
    std::shared_ptr<PtyPort> port_ = std::make_shared<PtyPort>(io_.get_executor(), link_);
};

TEST_F(TtyCutTest, HangsUpAndComesBackAtOnce) {
    ScannerWire first = ScannerWire::tty(link_);
    EXPECT_TRUE(is_answered(first));
    first.write("BM\nMD0540054000000\n");
    EXPECT_TRUE(run_until(io_, [&] { return device_.wanted(); }));
    port_->cut(Cut::rst);
    EXPECT_TRUE(is_hung_up(first));
    EXPECT_FALSE(device_.wanted());
    EXPECT_FALSE(port_->connected());

    ScannerWire second = ScannerWire::tty(link_);
    EXPECT_TRUE(is_answered(second));
    EXPECT_TRUE(port_->connected());
    EXPECT_EQ(device_.clients(), 1U);
}

TEST_F(TtyCutTest, IsAwayUnderItsNameWhileItIsUnplugged) {
    ScannerWire first = ScannerWire::tty(link_);
    EXPECT_TRUE(is_answered(first));
    port_->set_line({.hung_up = true});
    EXPECT_TRUE(is_hung_up(first));
    EXPECT_FALSE(has_name());
    EXPECT_EQ(port_->address(), link_);

    port_->set_line({});
    EXPECT_TRUE(run_until(io_, [&] { return fs::is_character_file(link_); }));
    ScannerWire second = ScannerWire::tty(link_);
    EXPECT_TRUE(is_answered(second));
}

TEST_F(TtyCutTest, RefusesWhoComesAndKeepsWhoHasItOpen) {
    {
        ScannerWire first = ScannerWire::tty(link_);
        EXPECT_TRUE(is_answered(first));
        port_->set_line({.refuses = true});
        EXPECT_TRUE(run_until(io_, [&] { return !has_name(); }));
        EXPECT_TRUE(is_answered(first));
        EXPECT_TRUE(port_->connected());
        port_->set_line({});
        EXPECT_TRUE(run_until(io_, [&] { return fs::is_character_file(link_); }));
        EXPECT_TRUE(is_answered(first));

        // Once it has gone, it is refused as well.
        port_->set_line({.refuses = true});
        first.write("BM\nMD0540054000000\n");
        EXPECT_TRUE(run_until(io_, [&] { return device_.wanted(); }));
    }
    EXPECT_TRUE(run_until(io_, [&] { return !port_->connected() && !device_.wanted(); }));
    EXPECT_FALSE(has_name());
    port_->set_line({});
    EXPECT_TRUE(run_until(io_, [&] { return fs::is_character_file(link_); }));
    ScannerWire second = ScannerWire::tty(link_);
    EXPECT_TRUE(is_answered(second));

    port_->set_line({.refuses = true});
    port_->cut(Cut::rst);
    EXPECT_TRUE(is_hung_up(second));
    EXPECT_FALSE(has_name());
}

TEST_F(TtyCutTest, WaitsForANameThatSomebodyElseHasTaken) {
    port_->set_line({.hung_up = true});
    EXPECT_TRUE(run_until(io_, [&] { return !fs::exists(fs::symlink_status(link_)); }));
    fs::create_directory(link_);
    port_->set_line({});
    turn();
    EXPECT_TRUE(fs::is_directory(link_));
    fs::remove(link_);
    EXPECT_TRUE(run_until(io_, [&] { return fs::is_character_file(link_); }));
    ScannerWire wire = ScannerWire::tty(link_);
    EXPECT_TRUE(is_answered(wire));
}

// A program that opens a tty with O_CREAT makes one, if the tty is away.
TEST_F(TtyCutTest, TakesItsNameBackFromAnEmptyFileThatWasMadeMeanwhile) {
    unplug();
    directory_.write("tty", "");
    port_->set_line({});
    EXPECT_TRUE(run_until(io_, [&] { return fs::is_symlink(link_); }));
    EXPECT_EQ(log_.text(), "");
    ScannerWire wire = ScannerWire::tty(link_);
    EXPECT_TRUE(is_answered(wire));
}

TEST_F(TtyCutTest, LeavesAnyOtherFileAloneAndNamesItOnce) {
    const auto old = [&] {
        directory_.write("tty", "");
        fs::last_write_time(link_, fs::file_time_type::clock::now() - 1h);
    };
    const auto full = [&] { directory_.write("tty", "VV\n"); };
    const auto elsewhere_too = [&] {
        directory_.write("tty", "");
        fs::create_hard_link(link_, directory_.path() / "other");
    };
    const std::vector<std::function<void()>> files{old, full, elsewhere_too};
    for (const auto& make : files) {
        log_.clear();
        unplug();
        make();
        port_->set_line({});
        io_.restart();
        io_.run_for(350ms);  // it has tried three times
        EXPECT_TRUE(fs::is_regular_file(link_));
        EXPECT_EQ(log_.text(),
                  "the tty " + link_.string() +
                      " is not there, and comes when it can: " + link_.string() +
                      " is there and is no link; remove it, or choose another name for "
                      "the tty\n");
        fs::remove(link_);
        EXPECT_TRUE(run_until(io_, [&] { return fs::is_symlink(link_); }));
    }
}

TEST_F(TtyCutTest, ServesAgainAndStopsWhileItIsAway) {
    unplug();
    port_->serve(device_);
    {
        ScannerWire wire = ScannerWire::tty(link_);
        EXPECT_TRUE(is_answered(wire));
    }
    port_->set_line({.hung_up = true});
    turn();
    port_->stop();
    port_->set_line({});
    turn();
    EXPECT_FALSE(fs::exists(fs::symlink_status(link_)));
}

class ClientCounter : public LineHook {
  public:
    void leaving(protocol::Send& /*message*/) override {}
    void connected(Port& port) override {
        ++clients;
        port.send_raw(std::string("\0\0", 2));
    }

    int clients = 0;
};

TEST_F(TtyCutTest, TellsItsFirstClientOnly) {
    ClientCounter counter;
    port_->set_hook(&counter);
    {
        const ScannerWire first = ScannerWire::tty(link_);
        EXPECT_TRUE(run_until(io_, [&] { return counter.clients == 1; }));
        ScannerWire second = ScannerWire::tty(link_);
        std::string received;
        EXPECT_TRUE(run_until(io_, [&] {
            std::array<char, 16> buffer;
            received.append(buffer.data(), second.read(buffer, 0ms));
            return received.size() >= 2;
        }));
        EXPECT_EQ(received, std::string("\0\0", 2));
        turn();
        EXPECT_EQ(counter.clients, 1);
    }
    EXPECT_TRUE(run_until(io_, [&] { return !port_->connected(); }));
    const ScannerWire third = ScannerWire::tty(link_);
    EXPECT_TRUE(run_until(io_, [&] { return counter.clients == 2; }));
}

}  // namespace
}  // namespace scipd::daemon
