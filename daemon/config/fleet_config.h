// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A world that many daemons share, and the broker that they share it by. Values; any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "daemon/config/broker_address.h"

namespace scipd::daemon {

/// Empty paths are not given.
struct BrokerTls {
    std::filesystem::path ca;    ///< whose certificates are good; else those of the system
    std::filesystem::path cert;  ///< what this daemon shows of itself
    std::filesystem::path key;

    bool operator==(const BrokerTls&) const = default;
};

struct FleetConfig {
    BrokerAddress broker;
    std::string world;
    std::string name;  ///< of this daemon among the others; empty: HOST-PID
    BrokerUser user;   ///< empty: none
    BrokerTls tls;
    /// What is farther from all robots here is left out; nothing: all is taken.
    std::optional<double> near_m;

    bool operator==(const FleetConfig&) const = default;
};

}  // namespace scipd::daemon
