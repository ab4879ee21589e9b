// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The condition that the faults which act want a device to be in, all of them together, and how a
// device gets into it and out of it again. Lives on its shard.
#pragma once

#include <optional>

#include "protocol/device_state.h"
#include "protocol/state.h"
#include "protocol/uptime.h"

namespace scipd::daemon {

class Device;

struct DeviceCondition {
    protocol::Trouble trouble = protocol::Trouble::none;
    double motor_error = 0.0;  ///< DeviceState::motor_error()
    bool asleep = false;
    std::optional<protocol::Uptime> spins_up_until;

    bool operator==(const DeviceCondition&) const = default;
};

class FaultedDevice {
  public:
    /// `device` must outlive it.
    explicit FaultedDevice(Device& device) : device_(device) {}

    /// Not from within a call of the device's.
    void set(const DeviceCondition& condition);
    /// By how much later the zero of its clock is than it would be; nothing: the clock is right.
    /// Any time.
    void shift_clock(std::optional<protocol::Uptime> shift);
    /// A boot has taken the device out of its condition: puts it there again.
    void booted();

  private:
    Device& device_;
    DeviceCondition condition_;
    struct Zero {
        protocol::Uptime right{};  ///< without a fault
        protocol::Uptime set{};
    };
    std::optional<Zero> clock_zero_;  ///< nothing: the clock is right
    bool slept_ = false;              ///< a client had put it to sleep before
};

}  // namespace scipd::daemon
