// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// An emulated scanner as the place of faults. Lives on its shard.
#pragma once

#include <utility>
#include <vector>

#include "daemon/device/device.h"
#include "daemon/faults/fault_run.h"

namespace scipd::daemon {

class DeviceSite final : public FaultSite {
  public:
    /// `device` must outlive it.
    DeviceSite(Device& device, std::vector<Port*> ports)
        : FaultSite(device.name(), std::move(ports)), device_(device) {}

    [[nodiscard]] Device& device() override { return device_; }
    [[nodiscard]] const Device& device() const { return device_; }
    [[nodiscard]] bool driven() const override { return device_.driven(); }
    void boot() override {
        const protocol::Uptime boot_time = device_.profile().boot_time;
        device_.change([&](protocol::DeviceState& state, protocol::Uptime now) {
            state.boot(now, boot_time);
        });
    }

  private:
    Device& device_;
};

}  // namespace scipd::daemon
