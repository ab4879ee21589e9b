// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scanner's TCP port: one client at a time; the next one waits in the backlog until the first is
// gone, as with a real scanner. Lives on the I/O thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include "daemon/config/config.h"
#include "daemon/device/device.h"
#include "daemon/link/connection.h"
#include "daemon/link/tcp_peer.h"

namespace scipd::daemon {

class TcpPort : public std::enable_shared_from_this<TcpPort> {
  public:
    /// Binds and listens. Throws std::runtime_error.
    TcpPort(const boost::asio::any_io_executor& executor, const Address& address);

    /// Whoever connects from now on talks to this device, over a link like this; who is connected
    /// is cut off. It must live until the next serve() or stop().
    void serve(Device& device, const LinkConfig& link = {});
    void stop();

    /// HOST:PORT, with the port that was really taken.
    [[nodiscard]] std::string address() const;
    [[nodiscard]] bool connected() const { return connection_ != nullptr; }
    [[nodiscard]] std::uint64_t lost_scans() const;

  private:
    void accept();
    void accept_later();
    void connect(boost::asio::ip::tcp::socket socket);
    void disconnect();
    /// Until it disconnects.
    void watch(int socket);
    void watch_on();

    boost::asio::ip::tcp::acceptor acceptor_;
    boost::asio::steady_timer pause_;
    Device* device_ = nullptr;
    LinkConfig link_;
    std::shared_ptr<Connection> connection_;
    std::optional<TcpPeer> peer_;  ///< where there is a bound for it
    boost::asio::steady_timer peer_timer_;
    std::uint64_t lost_before_ = 0;  ///< by connections that have ended
    bool accepting_ = false;
};

}  // namespace scipd::daemon
