// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/handlers.h"

#include <utility>
#include <variant>

#include "protocol/rehearsal.h"
#include "protocol/reply_grid.h"
#include "protocol/reports.h"
#include "protocol/settings.h"

namespace scipd::protocol::handlers {
namespace {

// A reply that leaves at once tells the time halfway between its request and itself: urg_stamped
// and hokuyoaist take it for that. The simulator of the former, whose author had units, waits as
// long before it reads the clock as after. A reply that waits for a tick tells the time of the
// tick.
Uptime shown(const Call& call) {
    return call.now - call.profile.reply_delay / 2;
}

// Another speed of the motor holds from the next step 0 on. `before` is how the mirror turned.
void pass_on_speed(const Call& call, const Grid& before) {
    if (scan_period_of(call.device.settings(), call.profile) != before.tick)
        call.device.set_mirror_origin(before.after(call.now));
}

}  // namespace

Response report_version(const Call& call) {
    return version_report(call.request.echo, call.profile);
}

Response report_parameters(const Call& call) {
    return parameter_report(call.request.echo, call.profile);
}

Response report_state(const Call& call) {
    return state_report(call.request.echo, call.profile, call.device, shown(call));
}

Response report_state_number(const Call& call) {
    return state_number_report(call.request.echo, call.device, call.now);
}

Response report_time(const Call& call) {
    return time_report(call.request, call.device, shown(call));
}

Response switch_laser_on(const Call& call) {
    call.acquisition.hold_device();
    call.device.wake(call.now, call.profile.wake_time);
    call.device.switch_laser_on(call.now);
    return status::ok;
}

Response quit(const Call& call) {
    call.acquisition.stop();
    call.device.leave_adjust();
    call.device.wake(call.now, call.profile.wake_time);
    return status::ok;
}

Response sleep(const Call& call) {
    if (call.device.streaming()) return status::denied;
    call.acquisition.release_device();
    call.device.sleep();
    return status::ok;
}

Response reset(const Call& call) {
    const Grid mirror = mirror_of(call.device, call.profile);
    call.acquisition.release_device();
    call.device.wake(call.now, call.profile.wake_time);
    call.device.reset(call.now);
    pass_on_speed(call, mirror);
    return status::ok;
}

Response partial_reset(const Call& call) {
    call.acquisition.release_device();
    call.device.wake(call.now, call.profile.wake_time);
    call.device.partial_reset(call.now);
    return status::ok;
}

Response reboot(const Call& call) {
    const bool second = call.device.ask_reboot(call.now, call.profile.boot_time);
    return second ? status::ok : status::ask_again;
}

Response begin_single_scan(const Call& call) {
    const auto window = parse_step_window(call.request.parameters(), call.profile);
    if (const Status* fault = std::get_if<Status>(&window)) return *fault;
    call.acquisition.await_scan({call.request, std::get<StepWindow>(window), call.now});
    return AnsweredByScan{};
}

Response begin_stream(const Call& call) {
    const Uptime period = scan_period_of(call.device.settings(), call.profile);
    auto subscription = Subscription::from(call.request, call.arrived, period, call.profile);
    if (const Status* fault = std::get_if<Status>(&subscription)) return *fault;
    call.acquisition.stream(std::get<Subscription>(std::move(subscription)), call.now);
    return status::ok;
}

Response enter_adjust(const Call& call) {
    call.acquisition.hold_device();
    call.device.enter_adjust();
    return status::ok;
}

Response leave_adjust(const Call& call) {
    call.acquisition.release_device();
    call.device.leave_adjust();
    return status::ok;
}

Response refuse_digit(const Call&) {
    return status::no_such_mode;
}

Response set_bit_rate(const Call& call) {
    return protocol::set_bit_rate(call.device.settings(), call.request.parameters(), call.profile);
}

Response set_motor_level(const Call& call) {
    const Grid mirror = mirror_of(call.device, call.profile);
    const Status status =
        protocol::set_motor_level(call.device.settings(), call.request.parameters(), call.profile);
    pass_on_speed(call, mirror);
    return status;
}

Response set_sensitivity(const Call& call) {
    return protocol::set_sensitivity(call.device.settings(), call.request.parameters(),
                                     call.profile);
}

Response set_address(const Call& call) {
    return check_addresses(call.request.parameters());
}

Response rehearse(const Call& call) {
    return protocol::rehearse(call.device, call.request.parameters(), call.profile);
}

Response choose_scip2(const Call& call) {
    return call.profile.unknown_command;
}

}  // namespace scipd::protocol::handlers
