// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A made-up scanner that is small enough to write its replies down: 10 steps, 0 to 9, in a turn of
// 25 ms that passes 12; measured are 2 to 9; answers and sends scans on a grid of 1 ms.
#pragma once

#include "protocol/device_profile.h"

namespace scipd::protocol {

inline DeviceProfile test_profile(Family family = Family::ust) {
    DeviceProfile profile;
    profile.family = family;
    profile.vendor = "Nobody";
    profile.product = "Test";
    profile.firmware = "1.0";
    profile.protocol = "SCIP 2.2";
    profile.serial = "H1";
    profile.model = "TEST";
    profile.dmin_mm = 20;
    profile.dmax_mm = 30000;
    profile.ares = 12;
    profile.amin = 2;
    profile.amax = 9;
    profile.afrt = 5;
    profile.scan_rpm = 2400;
    profile.motor_speed = "2400";
    profile.mode_idle = "IDLE";
    profile.mode_measuring = "CLASSIC";
    profile.bit_rate = "USB";
    profile.health = "well";
    profile.last_step = 9;
    profile.nearest_mm = 21;
    profile.codes = {.nothing = 65533, .too_near = 4, .too_far = 65532, .not_measured = 19};
    profile.unknown_command = status::undefined;
    profile.scan_period = std::chrono::milliseconds(25);
    profile.reply_tick = profile.scan_tick = std::chrono::milliseconds(1);
    profile.multi_echo = family == Family::ethernet_multi_echo;
    profile.boot_time = std::chrono::seconds(5);
    profile.answers_while_booting = family == Family::ethernet_multi_echo;
    profile.wake_time = std::chrono::seconds(3);
    return profile;
}

}  // namespace scipd::protocol
