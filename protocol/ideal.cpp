// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/ideal.h"

#include <utility>

namespace scipd::protocol {

DeviceProfile answering_at_once(DeviceProfile profile) {
    profile.turns_per_reply = 0;
    profile.single_scan_is_next = false;
    for (Uptime* wait : {&profile.reply_tick, &profile.time_tick, &profile.scan_tick,
                         &profile.scan_delay, &profile.settle_time, &profile.reply_delay,
                         &profile.state_report_delay, &profile.pause_after_scan})
        *wait = Uptime::zero();
    return profile;
}

DeviceProfile ideal(DeviceProfile profile) {
    profile = answering_at_once(std::move(profile));
    profile.scan_period = profile.nominal_scan_period();
    profile.boot_time = profile.wake_time = Uptime::zero();
    return profile;
}

}  // namespace scipd::protocol
