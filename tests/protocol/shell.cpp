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
      other_actions_(clients),
      done_{-profile_.scan_period, profile_.scan_period} {
    for (int client = 0; client < clients; ++client)
        sessions_.push_back(std::make_unique<Session>(profile_, device_));
}

Uptime Shell::complete(const MirrorTurn& turn) const {
    return turn.start + turn.period * profile_.amax / profile_.ares;
}

Shell::MirrorTurn Shell::following(const MirrorTurn& turn) const {
    const Grid mirror = mirror_of(device_, profile_);
    const Uptime start = turn.start >= mirror.origin
                             ? mirror.after(turn.start)
                             : std::min(turn.start + turn.period, mirror.origin);
    return {start, start >= mirror.origin ? mirror.tick : turn.period};
}

// Turns that nobody wanted, or they would have been events. Before anything may change the mirror:
// they were at the speed of their time.
void Shell::catch_up() {
    while (complete(following(done_)) < now_)
        done_ = following(done_);
}

void Shell::receive(std::string_view bytes, int client) {
    catch_up();
    sessions_[client]->receive(bytes, now_);
    settle(client);
}

void Shell::advance_to(Uptime time) {
    for (Uptime at = next_event(); at <= time; at = next_event()) {
        now_ = at;
        if (complete(following(done_)) == at) complete_turn();
        while (!leaving_.empty() && leaving_.front().at <= at) {
            const Leaving leaving = leaving_.front();
            leaving_.pop_front();
            hand_out(leaving.client, leaving.turn);
        }
        for (int client = 0; client < clients(); ++client) {
            catch_up();
            sessions_[client]->advance(at);
            settle(client);
        }
    }
    now_ = time;
}

Uptime Shell::next_event() {
    catch_up();
    Uptime next = Uptime::max();
    for (const auto& session : sessions_) {
        if (session->measuring()) next = std::min(next, complete(following(done_)));
        if (const auto at = session->wake_at()) next = std::min(next, std::max(*at, now_));
    }
    if (!leaving_.empty()) next = std::min(next, leaving_.front().at);
    return next;
}

void Shell::complete_turn() {
    done_ = following(done_);
    const Uptime at = scan_leaves(complete(done_), device_, profile_);
    for (int client = 0; client < clients(); ++client) {
        if (sessions_[client]->turn_complete({done_.start}))
            leaving_.push_back({client, {done_.start}, at});
    }
}

void Shell::hand_out(int client, const Turn& turn) {
    std::vector<std::uint32_t> distances;
    std::vector<std::uint32_t> intensities;
    std::vector<StepEchoes> all_echoes;
    for (int step = profile_.amin; step <= profile_.amax; ++step) {
        distances.push_back(distance(step));
        intensities.push_back(intensity(step));
        if (echoes) all_echoes.push_back(echoes(step));
    }
    ++scans_made;
    sessions_[client]->take({turn, profile_.amin, distances, intensities, all_echoes}, now_);
    settle(client);
}

// Answers whoever waits for the latest complete scan and keeps what was sent.
void Shell::settle(int client) {
    Session& session = *sessions_[client];
    catch_up();
    const MirrorTurn next = following(done_);
    const Turn latest{complete(next) == now_ ? next.start : done_.start};
    if (latest.start >= Uptime::zero() && session.waits_for(latest)) hand_out(client, latest);
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
