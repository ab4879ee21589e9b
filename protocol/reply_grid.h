// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// When a scanner gets round to answering, and when its scans leave: old models when the mirror
// passes step 0, others on ticks of their own, some after a while. All of it runs on the device's
// own clock.
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

    /// The first one after `time`; where every instant is one, `time` itself.
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

/// The mirror passes step 0 at these instants; before their origin at those of an earlier speed.
[[nodiscard]] Grid mirror_of(const DeviceState& device, const DeviceProfile& profile);

/// When the reply to a request leaves that the device could look at from `ready` on: one tick
/// later where that is a tick itself. Without a command: of one that it does not know.
[[nodiscard]] Uptime reply_leaves(Uptime ready, const Command* command, const DeviceState& device,
                                  const DeviceProfile& profile);

/// When a scan leaves that is complete by then: where the mirror is waited for with its next pass
/// of step 0, so that every scan of a stream is of the same age.
[[nodiscard]] Uptime scan_leaves(Uptime complete, const DeviceState& device,
                                 const DeviceProfile& profile);

}  // namespace scipd::protocol
