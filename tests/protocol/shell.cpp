// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/protocol/shell.h"

#include <algorithm>
#include <utility>

#include "protocol/reply_grid.h"

namespace scipd::protocol {

Shell::Shell(DeviceProfile profile, int clients, DeviceState device)
    : profile_(std::move(profile)),
      device_(std::move(device)),
      sent_(clients),
      other_actions_(clients) {
    for (int client = 0; client < clients; ++client)
        sessions_.push_back(std::make_unique<Session>(profile_, device_));
}

Uptime Shell::start(std::int64_t turn) const {
    return turn * profile_.scan_period;
}

Uptime Shell::complete(std::int64_t turn) const {
    return start(turn) + profile_.scan_period * profile_.amax / profile_.ares;
}

Uptime Shell::leaves(std::int64_t turn) const {
    return tick_at_or_after(complete(turn), profile_.reply_tick);
}

void Shell::receive(std::string_view bytes, int client) {
    sessions_[client]->receive(bytes, now_);
    settle(client);
}

void Shell::advance_to(Uptime time) {
    for (Uptime at = next_event(); at <= time; at = next_event()) {
        now_ = at;
        if (complete(next_turn_) == at) complete_turn();
        while (!leaving_.empty() && leaves(leaving_.front().turn) <= at) {
            const Leaving leaving = leaving_.front();
            leaving_.pop_front();
            hand_out(leaving);
        }
        for (int client = 0; client < clients(); ++client) {
            sessions_[client]->advance(at);
            settle(client);
        }
    }
    now_ = time;
}

Uptime Shell::next_event() {
    while (complete(next_turn_) < now_)  // nobody wanted it, or next_event() would have named it
        next_turn_ = std::max(next_turn_ + 1, (now_ - complete(0)) / profile_.scan_period);
    Uptime next = Uptime::max();
    for (const auto& session : sessions_) {
        if (session->measuring()) next = std::min(next, complete(next_turn_));
        if (const auto at = session->wake_at()) next = std::min(next, std::max(*at, now_));
    }
    if (!leaving_.empty()) next = std::min(next, leaves(leaving_.front().turn));
    return next;
}

void Shell::complete_turn() {
    for (int client = 0; client < clients(); ++client) {
        if (sessions_[client]->turn_complete({start(next_turn_)}))
            leaving_.push_back({client, next_turn_});
    }
    ++next_turn_;
}

void Shell::hand_out(const Leaving& leaving) {
    std::vector<std::uint32_t> distances;
    std::vector<std::uint32_t> intensities;
    std::vector<StepEchoes> all_echoes;
    for (int step = profile_.amin; step <= profile_.amax; ++step) {
        distances.push_back(distance(step));
        intensities.push_back(intensity(step));
        if (echoes) all_echoes.push_back(echoes(step));
    }
    ++scans_made;
    sessions_[leaving.client]->take(
        {{start(leaving.turn)}, profile_.amin, distances, intensities, all_echoes}, now_);
    settle(leaving.client);
}

// Answers whoever waits for the latest complete scan and keeps what was sent.
void Shell::settle(int client) {
    Session& session = *sessions_[client];
    if (now_ >= complete(0)) {
        const std::int64_t latest = (now_ - complete(0)) / profile_.scan_period;
        if (session.waits_for({start(latest)})) hand_out({client, latest});
    }
    while (auto action = session.next_action()) {
        if (auto* message = std::get_if<Send>(&*action))
            sent_[client].push_back({now_, std::move(message->bytes), message->kind});
        else
            other_actions_[client].push_back(*action);
    }
}

std::vector<Sent> Shell::take_sent(int client) {
    return std::exchange(sent_[client], {});
}

std::vector<Action> Shell::take_other_actions(int client) {
    return std::exchange(other_actions_[client], {});
}

std::string Shell::take_text(int client) {
    std::string text;
    for (const Sent& sent : take_sent(client))
        text += sent.bytes;
    return text;
}

}  // namespace scipd::protocol
