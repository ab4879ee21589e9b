// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Sends datagrams to one port of 127.0.0.1, as a simulator sends its poses.
#pragma once

#include <cstdint>
#include <string_view>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/udp.hpp>

namespace scipd::tests {

class UdpSender {
  public:
    explicit UdpSender(std::uint16_t port = free_port())
        : port_(port), socket_(io_, boost::asio::ip::udp::v4()) {}

    /// The port that was given, or one that was free when this object was made.
    [[nodiscard]] std::uint16_t port() const { return port_; }

    void send(std::string_view datagram) const {
        socket_.send_to(boost::asio::buffer(datagram),
                        {boost::asio::ip::address_v4::loopback(), port_});
    }

  private:
    [[nodiscard]] static std::uint16_t free_port() {
        boost::asio::io_context io;
        const boost::asio::ip::udp::socket socket(io, {boost::asio::ip::address_v4::loopback(), 0});
        return socket.local_endpoint().port();
    }

    std::uint16_t port_;
    boost::asio::io_context io_;
    mutable boost::asio::ip::udp::socket socket_;
};

}  // namespace scipd::tests
