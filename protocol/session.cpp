// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/session.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "protocol/handlers.h"
#include "protocol/reply.h"
#include "protocol/reply_grid.h"
#include "protocol/scip1.h"
#include "protocol/settings.h"

namespace scipd::protocol {

Session::Session(const DeviceProfile& profile, DeviceState& device, LinkKind link)
    : profile_(profile),
      device_(device),
      link_(link),
      acquisition_(profile, device),
      boots_seen_(device.boots()),
      rate_told_(bit_rate_of(device.settings(), profile)) {}

void Session::receive(std::string_view bytes, Uptime now) {
    while (auto line = reader_.next(bytes)) {
        if (line->overlong && on_overlong_) on_overlong_();
        requests_.push_back({parse_request(std::move(*line), profile_), now});
    }
    advance(now);
}

void Session::limit_lines(std::size_t longest, std::function<void()> on_overlong) {
    reader_ = LineReader(longest);
    on_overlong_ = std::move(on_overlong);
}

std::optional<Uptime> Session::wake_at() const {
    if (link_lost() || rate_changed() || acquisition_.awaits_scan_in_vain())
        return std::max(last_answer_, Uptime::zero());
    std::optional<Uptime> at = device_.reboots_at();
    if (!requests_.empty() && !acquisition_.awaits_scan()) {
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
        } else if (acquisition_.awaits_scan_in_vain()) {
            refuse_single_scan(now);
        } else {
            answer_next(*at);
        }
    }
}

// A scanner looks at one request a tick: it answers a request that was sent right after a reply one
// tick later (recordings of a URG-04LX, a UTM-30LX and a UXM-30LX-E). The pause after a scan is for
// clients that stop reading at the empty line behind it: they would wait for ever for a reply that
// is glued to it.
Uptime Session::due(const Waiting& waiting) const {
    const Uptime ready = std::max(waiting.arrived, last_answer_);
    const Uptime due = std::max(reply_leaves(ready, waiting.request.command, device_, profile_),
                                last_scan_ + profile_.pause_after_scan);
    return profile_.answers_while_booting ? due : std::max(due, device_.booted_at());
}

void Session::take(const ScanView& scan, Uptime now) {
    // Asked before the last counted scan of a stream switches the laser off.
    const bool answers_single_scan = acquisition_.awaits(scan.turn);
    if (auto message = acquisition_.stream_message(scan)) {
        last_scan_ = now;
        send(std::move(*message), Send::Kind::scan);
    }
    if (!answers_single_scan) return;
    send(acquisition_.single_scan_reply(scan));
    last_answer_ = std::max(last_answer_, now);
    advance(now);
}

std::optional<Action> Session::next_action() {
    if (actions_.empty()) return std::nullopt;
    Action action = std::move(actions_.front());
    actions_.pop_front();
    return action;
}

void Session::close() {
    acquisition_.close();
    forget();
}

void Session::forget() {
    if (hook_ != nullptr) hook_->forget(*this);
    requests_.clear();
    acquisition_.forget_scan();
    // The rate of the line is the device's and outlives its clients.
    std::erase_if(actions_,
                  [](const Action& action) { return !std::holds_alternative<SetBitRate>(action); });
    reader_.forget();
}

void Session::lose_link() {
    boots_seen_ = device_.boots();
    acquisition_.lose();
    forget();
    actions_.emplace_back(DropLink{});
}

bool Session::rate_changed() const {
    return rate_told_ != bit_rate_of(device_.settings(), profile_);
}

void Session::tell_rate() {
    rate_told_ = bit_rate_of(device_.settings(), profile_);
    actions_.emplace_back(SetBitRate{rate_told_});
}

State Session::state(Uptime now) const {
    if (device_.booting(now)) return State::booting;
    if (device_.failed()) return State::error;
    if (device_.asleep()) return State::asleep;
    if (device_.adjusting()) return State::adjust;
    if (streaming()) return State::streaming;
    return device_.laser_on() ? State::measuring : State::standby;
}

// Another client may choose the language while a request waits, so that only now it is certain.
void Session::answer_next(Uptime now) {
    const Waiting waiting = std::move(requests_.front());
    requests_.pop_front();
    last_answer_ = now;
    const auto refused = hook_ == nullptr ? std::nullopt : hook_->refuse(waiting.request);
    if (device_.speaks_scip1()) {
        answer_scip1(waiting.request.echo, refused, now);
    } else if (refused) {
        reply(waiting.request, *refused);
    } else {
        answer(waiting, now);
    }
}

// A status of SCIP 1.1 has one character.
void Session::answer_scip1(const std::string& line, std::optional<Status> refused, Uptime now) {
    if (refused) return reply_scip1(line, refused->text().back());
    const Scip1Request request = parse_scip1(line, profile_);
    const char status = operate_scip1(device_, request, now);
    if (request.kind == Scip1Request::Kind::version) {
        send(scip1_version(line, profile_, device_));
    } else if (request.kind == Scip1Request::Kind::scan && status == scip1_status::ok) {
        acquisition_.await_scan({{.echo = line}, request.window});
    } else {
        reply_scip1(line, status);
    }
}

void Session::answer(const Waiting& waiting, Uptime now) {
    const Request& request = waiting.request;
    if (const auto status = refusal(request, now)) return reply(request, *status);
    Response response =
        request.command->handler({request, waiting.arrived, now, profile_, device_, acquisition_});
    if (const auto* status = std::get_if<Status>(&response)) reply(request, *status);
    if (auto* message = std::get_if<std::string>(&response)) send(std::move(*message));
}

void Session::refuse_single_scan(Uptime now) {
    const Request request = acquisition_.give_up_scan();
    if (request.command == nullptr) return reply_scip1(request.echo, scip1_status::unknown);
    reply(request, refusal(request, now).value_or(status::denied));
}

std::optional<Status> Session::refusal(const Request& request, Uptime now) const {
    return refusal_of(request, state(now), device_.trouble(), link_, profile_);
}

void Session::reply(const Request& request, Status status) {
    if (status != status::ok) ++refused_[std::string(status.text())];
    send(Reply(request.echo, status).finish());
}

void Session::reply_scip1(const std::string& line, char status) {
    if (status != scip1_status::ok) ++refused_[std::string(1, status)];
    send(scip1_reply(line, status));
}

void Session::send(std::string message, Send::Kind kind) {
    Send whole{std::move(message), kind};
    if (hook_ == nullptr) {
        actions_.emplace_back(std::move(whole));
        return;
    }
    for (Send& part : hook_->leave(*this, std::move(whole)))
        actions_.emplace_back(std::move(part));
}

}  // namespace scipd::protocol
