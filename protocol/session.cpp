// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/session.h"

#include <algorithm>
#include <utility>

#include "protocol/operations.h"
#include "protocol/rehearsal.h"
#include "protocol/reply.h"
#include "protocol/reply_grid.h"
#include "protocol/reports.h"
#include "protocol/scan_block.h"
#include "protocol/scip1.h"

namespace scipd::protocol {

Session::Session(const DeviceProfile& profile, DeviceState& device, LinkKind link)
    : profile_(profile),
      device_(device),
      link_(link),
      boots_seen_(device.boots()),
      rate_told_(bit_rate_of(device.settings(), profile)) {}

void Session::receive(std::string_view bytes, Uptime now) {
    while (auto line = reader_.next(bytes))
        requests_.push_back({std::move(*line), now});
    advance(now);
}

std::optional<Uptime> Session::wake_at() const {
    if (link_lost() || rate_changed() || single_shot_in_vain())
        return std::max(last_answer_, Uptime::zero());
    std::optional<Uptime> at = device_.reboots_at();
    if (!requests_.empty() && !single_shot_) {
        const Uptime answer = due(requests_.front());
        at = std::min(at.value_or(answer), answer);
    }
    return at;
}

void Session::advance(Uptime now) {
    for (auto at = wake_at(); at && *at <= now; at = wake_at()) {
        device_.advance(*at);
        if (link_lost()) {
            lose_link();
        } else if (rate_changed()) {
            tell_rate();
        } else if (single_shot_in_vain()) {
            refuse_single_shot(now);
        } else {
            answer_next(*at);
        }
    }
}

// A scanner looks at one request a tick: a request sent right after a reply is answered one tick
// later (recordings of a URG-04LX, a UTM-30LX and a UXM-30LX-E). Clients that stop reading at the
// empty line behind a scan would wait for ever for a reply that is glued to it.
Uptime Session::due(const Waiting& waiting) const {
    const Command* command = find_command(waiting.line.text, profile_);
    const Uptime due =
        std::max(reply_leaves(std::max(waiting.arrived, last_answer_), command, device_, profile_),
                 last_scan_ + profile_.pause_after_scan);
    return profile_.answers_while_booting ? due : std::max(due, device_.booted_at());
}

bool Session::turn_complete(const Turn& turn) {
    const bool taken = streaming() && subscription_->takes(turn, device_.laser_on_since());
    if (taken) taken_turns_.push_back(turn.start);
    return taken || waits_for(turn);
}

bool Session::waits_for(const Turn& turn) const {
    if (!single_shot_ || !device_.laser_on() || turn.start < device_.laser_on_since()) return false;
    if (!profile_.single_scan_is_next) return true;
    const Uptime period = scan_period_of(device_.settings(), profile_);
    const Uptime complete = turn.start + period * profile_.amax / profile_.ares;
    return scan_leaves(complete, device_, profile_) > single_shot_->begun;
}

void Session::take(const ScanView& scan, Uptime now) {
    // Before the last counted scan of a stream switches the laser off.
    const bool answers_single_shot = waits_for(scan.turn);
    if (std::erase(taken_turns_, scan.turn.start) > 0 && streaming()) send_scan(scan, now);
    if (answers_single_shot) answer_single_shot(scan, now);
}

std::optional<Action> Session::next_action() {
    if (actions_.empty()) return std::nullopt;
    Action action = std::move(actions_.front());
    actions_.pop_front();
    return action;
}

void Session::close() {
    if (holds_device_) {
        quit();
        device_.leave_adjust();
    }
    forget();
}

void Session::forget() {
    requests_.clear();
    single_shot_.reset();
    // The rate of the line is the device's and outlives its clients.
    std::erase_if(actions_,
                  [](const Action& action) { return !std::holds_alternative<SetBitRate>(action); });
    reader_ = {};
}

void Session::lose_link() {
    boots_seen_ = device_.boots();
    holds_device_ = false;
    subscription_.reset();
    close();
    actions_.emplace_back(DropLink{});
}

bool Session::rate_changed() const {
    return rate_told_ != bit_rate_of(device_.settings(), profile_);
}

void Session::tell_rate() {
    rate_told_ = bit_rate_of(device_.settings(), profile_);
    actions_.emplace_back(SetBitRate{rate_told_});
}

bool Session::streaming() const {
    return subscription_ && device_.streams(stream_);
}

State Session::state(Uptime now) const {
    if (device_.booting(now)) return State::booting;
    if (device_.failed()) return State::error;
    if (device_.asleep()) return State::asleep;
    if (device_.adjusting()) return State::adjust;
    if (streaming()) return State::streaming;
    return device_.laser_on() ? State::measuring : State::standby;
}

void Session::answer_next(Uptime now) {
    const Waiting waiting = std::move(requests_.front());
    requests_.pop_front();
    last_answer_ = now;
    if (device_.speaks_scip1()) {
        answer_scip1(waiting.line.text, now);
    } else {
        answer(parse_request(waiting.line, profile_), waiting.arrived, now);
    }
}

void Session::answer_scip1(const std::string& line, Uptime now) {
    const Scip1Request request = parse_scip1(line, profile_);
    const char status = operate_scip1(device_, request, now);
    if (request.kind == Scip1Request::Kind::version) {
        send(scip1_version(line, profile_, device_));
    } else if (request.kind == Scip1Request::Kind::scan && status == scip1_status::ok) {
        single_shot_ = SingleShot{{.echo = line}, request.window};
    } else {
        send(scip1_reply(line, status));
    }
}

void Session::answer(const Request& request, Uptime arrived, Uptime now) {
    if (const auto status = refusal(request, now)) return reply(request, *status);
    carry_out(request, arrived, now);
}

std::optional<Status> Session::refusal(const Request& request, Uptime now) const {
    return refusal_of(request, state(now), device_.trouble(), link_, profile_);
}

// Of a reply that leaves at once, halfway between it and its request: urg_stamped and hokuyoaist
// take it for that, and the former's simulator, whose author had units, waits as long before it
// reads the clock as after. Who waits for a tick reads it then.
Uptime Session::shown(Uptime now) const {
    return now - profile_.reply_delay / 2;
}

void Session::carry_out(const Request& request, Uptime arrived, Uptime now) {
    switch (request.command->operation) {
        case Operation::report_version:
            return send(version_report(request.echo, profile_));
        case Operation::report_parameters:
            return send(parameter_report(request.echo, profile_));
        case Operation::report_state:
            return send(state_report(request.echo, profile_, device_, shown(now)));
        case Operation::report_state_number:
            return send(state_number_report(request.echo, device_, now));
        case Operation::report_time:
            return send(time_report(request, device_, shown(now)));
        case Operation::single_shot:
            return begin_single_shot(request, now);
        case Operation::stream:
            return begin_stream(request, arrived, now);
        default:
            return reply(request, change(request, now));
    }
}

// What a client begins ends with it: the device is told from the rest of what requests change.
Status Session::change(const Request& request, Uptime now) {
    switch (request.command->operation) {
        case Operation::quit:
            quit();
            break;
        case Operation::switch_laser_on:
        case Operation::enter_adjust:
            holds_device_ = true;
            break;
        case Operation::sleep:
            if (device_.streaming()) return status::denied;  // to another client
            holds_device_ = false;
            break;
        case Operation::reset:
        case Operation::partial_reset:
        case Operation::leave_adjust:
            holds_device_ = false;
            break;
        default:
            break;
    }
    return operate(device_, request, profile_, now);
}

bool Session::single_shot_in_vain() const {
    return single_shot_ && (!device_.laser_on() || device_.failed());
}

void Session::begin_single_shot(const Request& request, Uptime now) {
    const auto window = parse_step_window(request.parameters(), profile_);
    if (const Status* fault = std::get_if<Status>(&window)) return reply(request, *fault);
    single_shot_ = SingleShot{request, std::get<StepWindow>(window), now};
}

// The laser has gone off or the device has failed while this one waited for a turn.
void Session::refuse_single_shot(Uptime now) {
    const SingleShot shot = std::move(*std::exchange(single_shot_, std::nullopt));
    if (shot.request.command == nullptr)
        return send(scip1_reply(shot.request.echo, scip1_status::unknown));
    reply(shot.request, refusal(shot.request, now).value_or(status::denied));
}

void Session::answer_single_shot(const ScanView& scan, Uptime now) {
    const SingleShot shot = std::move(*std::exchange(single_shot_, std::nullopt));
    if (shot.request.command == nullptr) {
        send(scip1_scan(shot.request.echo, scan, shot.window, profile_));
    } else {
        Reply reply(shot.request.echo, status::ok);
        add_scan(reply, scan, shot.window, shot.request.command->format, device_, profile_);
        send(reply.finish());
    }
    last_answer_ = std::max(last_answer_, now);
    advance(now);
}

// A request for a stream while one is running replaces it.
void Session::begin_stream(const Request& request, Uptime arrived, Uptime now) {
    const Uptime period = scan_period_of(device_.settings(), profile_);
    auto subscription = Subscription::from(request, arrived, period, profile_);
    if (const Status* fault = std::get_if<Status>(&subscription)) return reply(request, *fault);
    const DeviceState::StreamId replaced = std::exchange(stream_, device_.open_stream(now));
    device_.close_stream(replaced);
    subscription_ = std::get<Subscription>(std::move(subscription));
    taken_turns_.clear();  // the replaced one's
    holds_device_ = true;
    reply(request, status::ok);
}

void Session::send_scan(const ScanView& scan, Uptime now) {
    last_scan_ = now;
    rehearse_in_stream(device_, *subscription_);
    if (const auto status = subscription_->trouble(device_, profile_)) {
        send(subscription_->interruption(*status), Send::Kind::scan);
        if (device_.failed()) quit();
        return;
    }
    send(subscription_->message(scan, device_, profile_), Send::Kind::scan);
    if (subscription_->finished()) quit();
}

void Session::quit() {
    device_.close_stream(std::exchange(stream_, 0));
    subscription_.reset();
    device_.stop();
    holds_device_ = false;
}

void Session::reply(const Request& request, Status status) {
    send(Reply(request.echo, status).finish());
}

void Session::send(std::string message, Send::Kind kind) {
    actions_.emplace_back(Send{std::move(message), kind});
}

}  // namespace scipd::protocol
