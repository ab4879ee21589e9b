// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The ports of a rig, by what the configuration asks for, so that a port outlives a change of the
// scanner behind it. On the I/O thread, while the shards that they live on stand still.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "daemon/link/link_counts.h"

namespace scipd::daemon {

class HandedSockets;
class Port;
class Shards;
struct Config;
struct Homes;
struct SensorConfig;

using Ports = std::map<std::string, std::shared_ptr<Port>>;

/// The ports of one sensor; null where it has none of a kind.
struct SensorPorts {
    std::shared_ptr<Port> tcp;
    std::shared_ptr<Port> pty;

    /// What went over both.
    [[nodiscard]] LinkCounts counts() const;
};

/// Where ports are opened.
struct PortContext {
    Shards& shards;
    const Homes& now;   ///< of those that are open
    const Homes& next;  ///< of those that will be
    /// Sockets that were handed over for their addresses; null: none.
    const HandedSockets* handed;
};

/// All ports that the configuration asks for: those that are open already, and new ones for the
/// others. Throws std::runtime_error.
[[nodiscard]] Ports open_ports(const PortContext& context, const Config& config, const Ports& open);

/// The ports that open_ports() has opened for the sensor.
[[nodiscard]] SensorPorts ports_of(const Ports& ports, const std::string& robot,
                                   const SensorConfig& sensor);

/// Stops the open ports that nobody needs any more.
void stop_unneeded(const Ports& open, const Ports& needed);

}  // namespace scipd::daemon
