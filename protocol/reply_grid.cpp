// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/reply_grid.h"

#include <algorithm>

namespace scipd::protocol {
namespace {

// In time-adjust mode a UXM-30LX-E answered TM1 after 1 ms and TM2 after 2 ms.
constexpr Uptime prompt_tick = std::chrono::milliseconds(1);

// Scanners were recorded while they measured, and each reply waited for the mirror. With the laser
// off there are three replies of a UXM-30LX-E: TM1 and TM2 did not wait, the BM behind them did.
// Before SCIP 2.0 a URG-04LX answered V after 40 ms and G after 100; SCIP2.0 was not recorded, and
// a program that was written for one gives it 30 ms (HS2_LaserHokuyo).
bool waits_for_mirror(const Command* command, const DeviceState& device) {
    if (device.adjusting()) return false;
    if (!device.laser_on()) return command != nullptr && command->switches_laser_on();
    return !device.speaks_scip1() || command == nullptr || command->code != "SCIP2.0";
}

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
    const bool prompt =
        profile.turns_per_reply > 0 ? !waits_for_mirror(command, device) : device.adjusting();
    return prompt && grid.tick > prompt_tick ? Grid{.tick = prompt_tick} : grid;
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
    return grid.at_or_after(complete + profile.scan_delay);
}

}  // namespace scipd::protocol
