// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/broker/mqtt_link.h"

#include <chrono>
#include <cstdint>
#include <set>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

/// Where nobody listens.
std::uint16_t free_port(boost::asio::io_context& io) {
    using boost::asio::ip::tcp;
    return tcp::acceptor(io, {boost::asio::ip::address_v4::loopback(), 0}).local_endpoint().port();
}

// That there is no connection is no reason why there is none.
TEST(MqttLink, TellsAllTheWhileWhyThereIsNoConnection) {
    boost::asio::io_context io;
    MqttLink link(io.get_executor(), {.broker = {"127.0.0.1", free_port(io)}, .world = "hall"},
                  "test", {}, {});
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

}  // namespace
}  // namespace scipd::daemon
