// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// When a scanner gets round to answering: old models once a turn, the UTM-30LX every 25 ms, the UST
// every millisecond. The grid is that of the mirror, which passes step 0 at uptime 0.
#pragma once

#include "protocol/uptime.h"

namespace scipd::protocol {

/// In time-adjust mode, where the mirror is not waited for (recorded UXM-30LX-E).
inline constexpr Uptime adjust_tick = std::chrono::milliseconds(1);

/// The first tick after `time`; with a tick of 0, `time` itself.
[[nodiscard]] constexpr Uptime next_tick(Uptime time, Uptime tick) {
    if (tick <= Uptime::zero()) return time;
    return (time / tick + 1) * tick;
}

/// The first tick at or after `time`: when a scan that is complete by then leaves.
[[nodiscard]] constexpr Uptime tick_at_or_after(Uptime time, Uptime tick) {
    if (tick <= Uptime::zero() || time % tick == Uptime::zero()) return time;
    return next_tick(time, tick);
}

}  // namespace scipd::protocol
