// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which MQTT broker, as users write it: mqtt://HOST[:PORT], or mqtts:// with TLS. Values; any
// thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sim/expected.h"

namespace scipd::daemon {

struct BrokerAddress {
    std::string host;  ///< a name or numbers, IPv6 without brackets
    std::uint16_t port = 1883;
    bool tls = false;

    bool operator==(const BrokerAddress&) const = default;
};

/// A world that is shared by way of a broker.
struct SharedWorldName {
    BrokerAddress broker;
    std::string world;
};

/// "mqtt://127.0.0.1:1883"
std::string text_of(const BrokerAddress& address);

sim::Expected<BrokerAddress> parse_broker(std::string_view text);

/// What a topic may hold: letters, digits, _ - and dots.
sim::Expected<std::string> parse_world_name(std::string_view text);

/// mqtt://HOST[:PORT]/WORLD
sim::Expected<SharedWorldName> parse_broker_and_world(std::string_view text);

/// USER:PASSWORD, as the file of a user has them.
struct BrokerUser {
    std::string name;
    std::string password;

    bool operator==(const BrokerUser&) const = default;
};
sim::Expected<BrokerUser> parse_broker_user(std::string_view line);

}  // namespace scipd::daemon
