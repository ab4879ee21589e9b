// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/broker/mqtt_link.h"

#include <chrono>
#include <set>
#include <string>

#include <boost/asio/io_context.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

// That there is no connection is no reason why there is none.
TEST(MqttLink, TellsAllTheWhileWhyThereIsNoConnection) {
    boost::asio::io_context io;
    BrokerConfig nobody_listens;
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

}  // namespace
}  // namespace scipd::daemon
