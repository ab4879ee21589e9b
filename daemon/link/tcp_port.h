// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scanner's TCP port: one client at a time; the next ones wait until the first is gone, as with a
// real scanner. Of more than a few, the last are turned away. Lives on its shard.
#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include "daemon/config/address.h"
#include "daemon/link/port.h"
#include "daemon/link/tcp_peer.h"

namespace scipd::daemon {

class TcpPort : public Port, public std::enable_shared_from_this<TcpPort> {
  public:
    /// Binds and listens; or takes the descriptor of a socket that listens there already, and that
    /// somebody else holds open as well. Throws std::runtime_error.
    TcpPort(const boost::asio::any_io_executor& executor, const Address& address,
            std::optional<int> handed = {});

    /// One that listens on the same socket with another executor, where this one is to be stopped.
    /// It counts on, and gets whoever connects here meanwhile or waits. Throws
    /// std::runtime_error where there are no descriptors for a port in two places.
    [[nodiscard]] std::shared_ptr<TcpPort> moved_to(const boost::asio::any_io_executor& executor);

    /// Its serve() needs nothing.
    void prepare() override {}
    void serve(Endpoint& scanner, const LinkConfig& link = {}) override;
    void stop() override;

    [[nodiscard]] std::string address() const override;
    [[nodiscard]] bool connected() const override { return connection() != nullptr; }
    [[nodiscard]] std::vector<std::string> waiting() override;
    [[nodiscard]] protocol::LinkKind kind() const override { return protocol::LinkKind::network; }
    void cut(Cut how) override;

  private:
    void follow_line() override;
    /// On the address that it had before.
    void listen();
    /// Tries until it listens, or is not to listen any more.
    void listen_again();
    void close();
    void accept();
    void accept_later();
    void take_in(boost::asio::ip::tcp::socket socket);
    /// To the one that it was moved to; where there is none, as turn_all_away().
    void pass_on(boost::asio::ip::tcp::socket socket);
    void serve_next();
    /// False: no more clients may wait.
    [[nodiscard]] bool make_room();
    void turn_all_away();
    void connect(boost::asio::ip::tcp::socket socket);
    void disconnect(Leaving why);
    /// Looks whether the client's machine is still there, until it disconnects.
    void watch(int socket);
    void watch_on();

    boost::asio::ip::tcp::acceptor acceptor_;  ///< closed: it refuses clients, or was stopped
    bool handed_;                              ///< whoever handed it over would listen on
    boost::asio::ip::tcp::endpoint endpoint_;  ///< with the port that was really taken
    boost::asio::steady_timer pause_;
    Endpoint* scanner_ = nullptr;  ///< null: stopped, or not served yet
    std::weak_ptr<TcpPort> moved_to_;
    std::optional<TcpPeer> peer_;  ///< where a silent client has a time limit
    std::chrono::nanoseconds dead_after_{};
    boost::asio::steady_timer peer_timer_;
    bool accepting_ = false;
    std::deque<boost::asio::ip::tcp::socket> waiting_;  ///< clients, the next one first
};

}  // namespace scipd::daemon
