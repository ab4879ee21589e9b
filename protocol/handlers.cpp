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
Uptime shown(const RequestContext& context) {
    return context.now - context.profile.reply_delay / 2;
}

// Another speed of the motor holds from the next step 0 on. `before` is how the mirror turned.
void pass_on_speed(const RequestContext& context, const Grid& before) {
    if (scan_period_of(context.device.settings(), context.profile) != before.tick)
        context.device.set_mirror_origin(before.after(context.now));
}

}  // namespace

Response report_version(const RequestContext& context) {
    return version_report(context.request.echo, context.profile);
}

Response report_parameters(const RequestContext& context) {
    return parameter_report(context.request.echo, context.profile);
}

Response report_state(const RequestContext& context) {
    return state_report(context.request.echo, context.profile, context.device, shown(context));
}

Response report_state_number(const RequestContext& context) {
    return state_number_report(context.request.echo, context.device, context.now);
}

Response report_time(const RequestContext& context) {
    return time_report(context.request, context.device, shown(context));
}

Response switch_laser_on(const RequestContext& context) {
    context.acquisition.hold_device();
    context.device.wake(context.now, context.profile.wake_time);
    context.device.switch_laser_on(context.now);
    return status::ok;
}

Response quit(const RequestContext& context) {
    context.acquisition.stop();
    context.device.leave_adjust();
    context.device.wake(context.now, context.profile.wake_time);
    return status::ok;
}

Response sleep(const RequestContext& context) {
    if (context.device.streaming()) return status::denied;
    context.acquisition.release_device();
    context.device.sleep();
    return status::ok;
}

Response reset(const RequestContext& context) {
    const Grid mirror = mirror_of(context.device, context.profile);
    context.acquisition.release_device();
    context.device.wake(context.now, context.profile.wake_time);
    context.device.reset(context.now);
    pass_on_speed(context, mirror);
    return status::ok;
}

Response partial_reset(const RequestContext& context) {
    context.acquisition.release_device();
    context.device.wake(context.now, context.profile.wake_time);
    context.device.partial_reset(context.now);
    return status::ok;
}

Response reboot(const RequestContext& context) {
    const bool second = context.device.ask_reboot(context.now, context.profile.boot_time);
    return second ? status::ok : status::ask_again;
}

Response begin_single_scan(const RequestContext& context) {
    const auto window = parse_step_window(context.request.parameters(), context.profile);
    if (const Status* fault = std::get_if<Status>(&window)) return *fault;
    context.acquisition.await_scan({context.request, std::get<StepWindow>(window), context.now});
    return AnsweredByScan{};
}

Response begin_stream(const RequestContext& context) {
    const Uptime period = scan_period_of(context.device.settings(), context.profile);
    auto subscription =
        Subscription::from(context.request, context.arrived, period, context.profile);
    if (const Status* fault = std::get_if<Status>(&subscription)) return *fault;
    context.acquisition.stream(std::get<Subscription>(std::move(subscription)), context.now);
    return status::ok;
}

Response enter_adjust(const RequestContext& context) {
    context.acquisition.hold_device();
    context.device.enter_adjust();
    return status::ok;
}

Response leave_adjust(const RequestContext& context) {
    context.acquisition.release_device();
    context.device.leave_adjust();
    return status::ok;
}

Response refuse_digit(const RequestContext&) {
    return status::no_such_mode;
}

Response set_bit_rate(const RequestContext& context) {
    return protocol::set_bit_rate(context.device.settings(), context.request.parameters(),
                                  context.profile);
}

Response set_motor_level(const RequestContext& context) {
    const Grid mirror = mirror_of(context.device, context.profile);
    const Status status = protocol::set_motor_level(context.device.settings(),
                                                    context.request.parameters(), context.profile);
    pass_on_speed(context, mirror);
    return status;
}

Response set_sensitivity(const RequestContext& context) {
    return protocol::set_sensitivity(context.device.settings(), context.request.parameters(),
                                     context.profile);
}

Response set_address(const RequestContext& context) {
    return check_addresses(context.request.parameters());
}

Response rehearse(const RequestContext& context) {
    return protocol::rehearse(context.device, context.request.parameters(), context.profile);
}

Response choose_scip2(const RequestContext& context) {
    return context.profile.unknown_command;
}

}  // namespace scipd::protocol::handlers
