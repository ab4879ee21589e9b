// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/operations.h"

#include <cassert>

#include "protocol/rehearsal.h"
#include "protocol/reply_grid.h"
#include "protocol/settings.h"

namespace scipd::protocol {
namespace {

Status carry_out(DeviceState& device, const Request& request, const DeviceProfile& profile,
                 Uptime now) {
    const std::string_view digits = request.parameters();
    switch (request.command->operation) {
        case Operation::switch_laser_on:
            device.wake(now, profile.wake_time);
            device.switch_laser_on(now);
            break;
        case Operation::quit:
            device.leave_adjust();
            device.wake(now, profile.wake_time);
            break;
        case Operation::sleep:
            device.sleep();
            break;
        case Operation::reset:
            device.wake(now, profile.wake_time);
            device.reset(now);
            break;
        case Operation::partial_reset:
            device.wake(now, profile.wake_time);
            device.partial_reset(now);
            break;
        case Operation::reboot:
            return device.ask_reboot(now, profile.boot_time) ? status::ok : Status("01");
        case Operation::enter_adjust:
            device.enter_adjust();
            break;
        case Operation::leave_adjust:
            device.leave_adjust();
            break;
        case Operation::refuse_digit:
            return "01";
        case Operation::set_bit_rate:
            return set_bit_rate(device.settings(), digits, profile);
        case Operation::set_motor_level:
            return set_motor_level(device.settings(), digits, profile);
        case Operation::set_sensitivity:
            return set_sensitivity(device.settings(), digits, profile);
        case Operation::rehearse:
            return rehearse(device, digits, profile);
        case Operation::set_address:
            return check_addresses(digits);
        case Operation::choose_scip2:  // it is spoken already
            return profile.unknown_command;
        default:
            assert(false && "not the device's");
    }
    return status::ok;
}

}  // namespace

// Another speed of the motor holds from the next step 0 on.
Status operate(DeviceState& device, const Request& request, const DeviceProfile& profile,
               Uptime now) {
    const Grid mirror = mirror_of(device, profile);
    const Status status = carry_out(device, request, profile, now);
    if (scan_period_of(device.settings(), profile) != mirror.tick)
        device.set_mirror_origin(mirror.after(now));
    return status;
}

}  // namespace scipd::protocol
