// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/mqtt_link.h"

#include <chrono>
#include <set>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using boost::asio::ip::tcp;

/// TCP_NODELAY of this program's socket whose other end is that port of this machine; -1: there is
/// no such socket.
int nodelay_of_socket_to(int port) {
    for (int file = 0; file < 1024; ++file) {
        sockaddr_in peer{};
        socklen_t size = sizeof(peer);
        if (::getpeername(file, reinterpret_cast<sockaddr*>(&peer), &size) != 0) continue;
        if (peer.sin_family != AF_INET || ntohs(peer.sin_port) != port) continue;
        int value = -1;
        size = sizeof(value);
        ::getsockopt(file, IPPROTO_TCP, TCP_NODELAY, &value, &size);
        return value;
    }
    return -1;
}

// That there is no connection is no reason why there is none.
TEST(MqttLink, TellsAllTheWhileWhyThereIsNoConnection) {
    boost::asio::io_context io;
    FleetConfig nobody_listens;
    nobody_listens.broker.host = "127.0.0.1";
    nobody_listens.broker.port = 1;
    MqttLink link(io.get_executor(), nobody_listens, "test", {}, {});
    EXPECT_FALSE(link.run_until([] { return false; }, 300ms));
    EXPECT_THAT(link.trouble(), testing::HasSubstr("refused"));
    std::set<std::string> told;
    link.begin();
    const auto end = std::chrono::steady_clock::now() + 1800ms;
    while (std::chrono::steady_clock::now() < end) {
        io.run_one_for(50ms);
        told.insert(link.trouble());
    }
    EXPECT_THAT(told, testing::ElementsAre(testing::HasSubstr("refused")));
    link.stop();
}

// With Nagle's algorithm, the second of two messages came 40 ms after the first.
TEST(MqttLink, LetsNoMessageWaitForTheOneBeforeIt) {
    boost::asio::io_context io;
    tcp::acceptor broker(io, {boost::asio::ip::address_v4::loopback(), 0});
    FleetConfig config;
    config.broker.host = "127.0.0.1";
    config.broker.port = broker.local_endpoint().port();
    MqttLink link(io.get_executor(), config, "test", {}, {});
    link.run_until([] { return false; }, 200ms);
    EXPECT_EQ(nodelay_of_socket_to(config.broker.port), 1);
    link.stop();
}

}  // namespace
}  // namespace scipd::daemon
