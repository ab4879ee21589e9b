// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Observes the traffic of a scanner while somebody wants it, as entries: requests and replies with
// their meaning, also for the log at `debug`, scans at `trace`. Lives on its shard.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/time.h"

namespace scipd::daemon {

class Device;
class Port;
class WireEar;

/// A request or a reply on the wire, with its meaning.
struct WireEntry {
    std::string client;  ///< "tcp" or "tty"
    sim::Time told{};    ///< as people call the time
    bool from_client = false;
    std::string line;  ///< the request, or the echo of the reply
    std::size_t bytes = 0;
    std::string means;
    std::string status = {};    ///< empty: none
    std::string explains = {};  ///< what the status means here
    std::optional<std::int64_t> scan = std::nullopt;
};

using TakeEntry = std::function<void(WireEntry)>;

class WireTap {
  public:
    /// The device must outlive it.
    /// `log` hears everything, whether somebody else wants to or not; null: it hears nothing.
    WireTap(Device& device, std::vector<std::shared_ptr<Port>> ports, TakeEntry log = nullptr);
    WireTap(const WireTap&) = delete;
    WireTap& operator=(const WireTap&) = delete;
    ~WireTap();

    /// Null: nobody wants to hear.
    void listen(const TakeEntry& take);

  private:
    void remove_ears();

    Device& device_;
    std::vector<std::shared_ptr<Port>> ports_;
    TakeEntry log_;
    std::vector<std::unique_ptr<WireEar>> ears_;  ///< one at each port; empty: nobody listens
};

/// Returns null if the log does not tell that much. `scanner` is its name in the log.
[[nodiscard]] TakeEntry wire_log(const std::string& scanner);

/// "tcp hears BM: switches the laser on", "tcp answers BM with 02: the laser is on already"
[[nodiscard]] std::string line_of(const WireEntry& entry);

}  // namespace scipd::daemon
