// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Listens to all that is said to a scanner and by it, while somebody wants to hear. Lives on its
// shard.
#pragma once

#include <memory>
#include <vector>

#include "daemon/wire/wire_entry.h"

namespace scipd::daemon {

class Device;
class Port;
class WireEar;

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

}  // namespace scipd::daemon
