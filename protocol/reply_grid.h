// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// When replies and scans leave: on old models that measure when the mirror passes step 0, on others
// at ticks or after a delay. All of it runs on the device's own clock.
#pragma once

#include "protocol/command.h"
#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/uptime.h"

namespace scipd::protocol {

/// Instants at even distances. There is none before the origin.
struct Grid {
    Uptime origin{};
    Uptime tick{};  ///< 0: every instant is one

    /// The first instant after `time`. Without a tick: `time` itself.
    [[nodiscard]] constexpr Uptime after(Uptime time) const {
        if (tick <= Uptime::zero()) return time;
        return time < origin ? origin : origin + ((time - origin) / tick + 1) * tick;
    }
    [[nodiscard]] constexpr Uptime at_or_after(Uptime time) const {
        if (tick <= Uptime::zero()) return time;
        return after(time - Uptime(1));
    }

    constexpr bool operator==(const Grid&) const = default;
};

/// One turn at the speed that the motor is set to (CR).
[[nodiscard]] Uptime scan_period_of(const Settings& settings, const DeviceProfile& profile);

/// The instants at which the mirror passes step 0. Before the origin it turned at another speed.
[[nodiscard]] Grid mirror_of(const DeviceState& device, const DeviceProfile& profile);

/// When the reply leaves to a request that the device can look at from `ready` on: at the first
/// tick after `ready`. Null: a command that the device does not know.
[[nodiscard]] Uptime reply_leaves(Uptime ready, const Command* command, const DeviceState& device,
                                  const DeviceProfile& profile);

/// When a scan leaves whose last step was fired at `complete`. On models that wait for the mirror
/// it leaves with the next pass of step 0, so that all scans of a stream are of the same age.
[[nodiscard]] Uptime scan_leaves(Uptime complete, const DeviceState& device,
                                 const DeviceProfile& profile);

}  // namespace scipd::protocol
