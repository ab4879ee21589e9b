// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/session.h"

#include <algorithm>
#include <utility>

#include "protocol/reply.h"
#include "protocol/reply_grid.h"
#include "protocol/timestamp.h"

namespace scipd::protocol {

Session::Session(const DeviceProfile& profile, DeviceState& device)
    : profile_(profile), device_(device) {}

Session::~Session() {
    close();
}

void Session::receive(std::string_view bytes, Uptime now) {
    while (auto line = reader_.next(bytes))
        requests_.push_back({std::move(*line), now});
    advance(now);
}

std::optional<Uptime> Session::wake_at() const {
    if (single_shot_ && !device_.laser_on()) return last_answer_;
    if (requests_.empty() || single_shot_) return std::nullopt;
    return due(requests_.front());
}

void Session::advance(Uptime now) {
    if (single_shot_ && !device_.laser_on()) refuse_single_shot();
    for (auto at = wake_at(); at && *at <= now; at = wake_at()) {
        Waiting waiting = std::move(requests_.front());
        requests_.pop_front();
        last_answer_ = *at;
        answer(parse_request(std::move(waiting.line), profile_.family), waiting.arrived, *at);
    }
}

// A scanner looks at one request a tick: a request sent right after a reply is answered one tick
// later (recordings of a URG-04LX, 100 ms, and a UTM-30LX, 25 ms). In adjust mode there is nothing
// that could make it wait (UXM-30LX-E: 1 ms).
Uptime Session::due(const Waiting& waiting) const {
    const Uptime tick =
        device_.adjusting() ? std::min(profile_.reply_tick, adjust_tick) : profile_.reply_tick;
    return next_tick(std::max(waiting.arrived, last_answer_), tick);
}

bool Session::turn_complete(const Turn& turn) {
    const bool taken = streaming() && subscription_->takes(turn, device_.laser_on_since());
    if (taken) taken_turns_.push_back(turn.start);
    return taken || waits_for(turn);
}

bool Session::waits_for(const Turn& turn) const {
    return single_shot_ && device_.laser_on() && turn.start >= device_.laser_on_since();
}

void Session::take(const ScanView& scan, Uptime now) {
    // Before the last counted scan of a stream switches the laser off.
    const bool answers_single_shot = waits_for(scan.turn);
    if (std::erase(taken_turns_, scan.turn.start) > 0 && streaming()) {
        send(subscription_->message(scan, device_.clock_zero(), profile_), Send::Kind::scan);
        if (subscription_->finished()) quit();
    }
    if (answers_single_shot) {
        const SingleShot shot = std::move(*std::exchange(single_shot_, std::nullopt));
        const DataFormat format = shot.request.command->format;
        send(Reply(shot.request.echo, status::ok)
                 .line(encoded_timestamp(scan.turn.start, device_.clock_zero()))
                 .data(values_in(scan, shot.window, format, profile_), format.width)
                 .finish());
        last_answer_ = std::max(last_answer_, now);
        advance(now);
    }
}

std::optional<Send> Session::next_message() {
    if (messages_.empty()) return std::nullopt;
    Send message = std::move(messages_.front());
    messages_.pop_front();
    return message;
}

void Session::close() {
    if (holds_device_) {
        quit();
        device_.leave_adjust();
    }
    requests_.clear();
    single_shot_.reset();
    messages_.clear();
    reader_ = {};
}

bool Session::streaming() const {
    return subscription_ && device_.streams(stream_);
}

State Session::state() const {
    if (device_.adjusting()) return State::adjust;
    if (streaming()) return State::streaming;
    return device_.laser_on() ? State::measuring : State::standby;
}

void Session::answer(const Request& request, Uptime arrived, Uptime now) {
    if (const auto status = refusal(request)) {
        reply(request, *status);
    } else {
        carry_out(request, arrived, now);
    }
}

// The state is looked at before the parameters: a bare GD with the laser off is 10 on a UST-10LX,
// not 0C.
std::optional<Status> Session::refusal(const Request& request) const {
    if (request.fault) return request.fault;
    if (request.command == nullptr) return profile_.unknown_command;
    if (const auto status = request.command->gate(profile_.family).refusal(state())) return status;
    const std::size_t expected = width(request.command->parameters);
    if (request.parameters_length < expected) return status::too_short;
    if (request.parameters_length > expected) return status::too_long;
    return std::nullopt;
}

void Session::carry_out(const Request& request, Uptime arrived, Uptime now) {
    switch (request.command->operation) {
        case Operation::report_version:
            return report_version(request);
        case Operation::report_parameters:
            return report_parameters(request);
        case Operation::report_state:
            return report_state(request, now);
        case Operation::report_time:
            return report_time(request, now);
        case Operation::single_shot:
            return begin_single_shot(request);
        case Operation::stream:
            return begin_stream(request, arrived, now);
        case Operation::refuse_digit:
            return reply(request, Status("01"));
        case Operation::switch_laser_on:
            device_.switch_laser_on(now);
            holds_device_ = true;
            break;
        case Operation::quit:
            quit();
            device_.leave_adjust();
            break;
        case Operation::reset:
            device_.reset(now);
            holds_device_ = false;
            break;
        case Operation::enter_adjust:
            device_.enter_adjust();
            holds_device_ = true;
            break;
        case Operation::leave_adjust:
            device_.leave_adjust();
            holds_device_ = false;
            break;
    }
    reply(request, status::ok);
}

void Session::report_version(const Request& request) {
    send(Reply(request.echo, status::ok)
             .entry("VEND", profile_.vendor)
             .entry("PROD", profile_.product)
             .entry("FIRM", profile_.firmware)
             .entry("PROT", profile_.protocol)
             .entry("SERI", profile_.serial)
             .finish());
}

void Session::report_parameters(const Request& request) {
    send(Reply(request.echo, status::ok)
             .entry("MODL", profile_.model)
             .entry("DMIN", profile_.dmin_mm)
             .entry("DMAX", profile_.dmax_mm)
             .entry("ARES", profile_.ares)
             .entry("AMIN", profile_.amin)
             .entry("AMAX", profile_.amax)
             .entry("AFRT", profile_.afrt)
             .entry("SCAN", profile_.scan_rpm)
             .finish());
}

void Session::report_state(const Request& request, Uptime now) {
    const bool on = device_.laser_on();
    const Uptime zero = device_.clock_zero();
    send(Reply(request.echo, status::ok)
             .entry("MODL", profile_.model)
             .entry("LASR", on ? "ON" : "OFF")
             .entry("SCSP", profile_.motor_speed)
             .entry("MESM", on ? profile_.mode_measuring : profile_.mode_idle)
             .entry("SBPS", profile_.bit_rate)
             .entry("TIME", profile_.time_spelling == TimeSpelling::hexadecimal
                                ? hexadecimal_timestamp(now, zero)
                                : encoded_timestamp(now, zero))
             .entry("STAT", profile_.health)
             .finish());
}

void Session::report_time(const Request& request, Uptime now) {
    send(Reply(request.echo, status::ok)
             .line(encoded_timestamp(now, device_.clock_zero()))
             .finish());
}

void Session::begin_single_shot(const Request& request) {
    const auto window = parse_step_window(request.parameters(), profile_);
    if (const Status* fault = std::get_if<Status>(&window)) return reply(request, *fault);
    single_shot_ = SingleShot{request, std::get<StepWindow>(window)};
}

// Another client has switched the laser off while this one waited for a turn.
void Session::refuse_single_shot() {
    const SingleShot shot = std::move(*std::exchange(single_shot_, std::nullopt));
    reply(shot.request, refusal(shot.request).value_or(status::denied));
}

// A request for a stream while one is running replaces it.
void Session::begin_stream(const Request& request, Uptime arrived, Uptime now) {
    auto subscription = Subscription::from(request, arrived, profile_);
    if (const Status* fault = std::get_if<Status>(&subscription)) return reply(request, *fault);
    const DeviceState::StreamId replaced = std::exchange(stream_, device_.open_stream(now));
    device_.close_stream(replaced);
    subscription_ = std::get<Subscription>(std::move(subscription));
    taken_turns_.clear();  // the replaced one's
    holds_device_ = true;
    reply(request, status::ok);
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
    messages_.push_back({std::move(message), kind});
}

}  // namespace scipd::protocol
