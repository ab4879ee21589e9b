// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/reply_grid.h"

#include <algorithm>

namespace scipd::protocol {
namespace {

// In time-adjust mode a scanner does not wait for its mirror (recorded UXM-30LX-E).
constexpr Uptime adjust_tick = std::chrono::milliseconds(1);

Grid replies_of(const DeviceState& device, const DeviceProfile& profile) {
    if (profile.turns_per_reply == 0) return {.tick = profile.reply_tick};
    Grid mirror = mirror_of(device, profile);
    mirror.tick *= profile.turns_per_reply;
    return mirror;
}

Grid grid_of(const Command* command, const DeviceState& device, const DeviceProfile& profile) {
    const bool asks_time = command != nullptr && command->code.ends_with("TM1");
    if (asks_time && profile.time_tick > Uptime::zero()) return {.tick = profile.time_tick};
    const Grid grid = replies_of(device, profile);
    return device.adjusting() && grid.tick > adjust_tick ? Grid{.tick = adjust_tick} : grid;
}

}  // namespace

// Level n is n % slower: MRPT asks for (600 - rpm) / 6 of a URG-04LX that turns at 600 rpm.
Uptime scan_period_of(const Settings& settings, const DeviceProfile& profile) {
    return profile.scan_period * 100 / (100 - settings.motor_level);
}

Grid mirror_of(const DeviceState& device, const DeviceProfile& profile) {
    const Uptime period = scan_period_of(device.settings(), profile);
    if (device.motor_error() == 0.0) return {device.mirror_origin(), period};
    const double share = 1.0 + device.motor_error();
    return {
        device.mirror_origin(),
        std::chrono::round<Uptime>(std::chrono::duration<double, Uptime::period>(period) / share)};
}

Uptime reply_leaves(Uptime ready, const Command* command, const DeviceState& device,
                    const DeviceProfile& profile) {
    const bool asks_state = command != nullptr && command->code == "II";
    const Uptime delay = asks_state ? std::max(profile.reply_delay, profile.state_report_delay)
                                    : profile.reply_delay;
    return grid_of(command, device, profile).after(ready + delay);
}

Uptime scan_leaves(Uptime complete, const DeviceState& device, const DeviceProfile& profile) {
    const Grid grid =
        profile.turns_per_reply > 0 ? mirror_of(device, profile) : Grid{.tick = profile.scan_tick};
    return grid.at_or_after(complete);
}

}  // namespace scipd::protocol
