// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/protocol/script.h"

#include <algorithm>
#include <string_view>

#include "tests/protocol/listener.h"
#include "tests/protocol/shown.h"

namespace scipd::protocol {
namespace {

using namespace std::chrono_literals;

std::string to_text(const Event& event) {
    switch (event.kind) {
        case Event::Kind::say:
            return "client " + std::to_string(event.client) + " says " + shown(event.bytes);
        case Event::Kind::wait:
            return milliseconds(event.time) + " pass";
        case Event::Kind::boot:
            return "it boots, if it has to";
        case Event::Kind::hang_up:
            return "client " + std::to_string(event.client) + " hangs up";
        case Event::Kind::trouble:
            return "trouble " + std::to_string(static_cast<int>(event.trouble));
        case Event::Kind::power_cycle:
            return "power off and on";
    }
    return {};
}

DeviceState powered_up(const Script& script) {
    DeviceState device;
    if (script.power_up == Script::PowerUp::cold) device.boot(0s, script.profile.boot_time);
    if (script.power_up == Script::PowerUp::scip1) device.power_up_in_scip1(0s);
    constexpr auto wrap = std::chrono::milliseconds(1 << 24);
    if (script.clock_wraps) device.set_clock(0s, wrap - 1s);
    return device;
}

// Distances, codes and what no model can see.
std::uint32_t seen_at(int step) {
    return static_cast<std::uint32_t>(step) * 2654435761U % 70'000U;
}

StepEchoes echoes_at(int step) {
    const std::uint32_t near = seen_at(step);
    return {.echo = {{{near, 262'143}, {near + 1000, 2}, {near + 2000, 3}}}, .count = 1 + step % 3};
}

class Performance {
  public:
    explicit Performance(const Script& script)
        : script_(script), shell_(script.profile, script.clients, powered_up(script)) {
        shell_.distance = seen_at;
        shell_.echoes = echoes_at;
        outcome_.told.resize(static_cast<std::size_t>(script.clients));
        for (int client = 0; client < script.clients; ++client)
            listeners_.emplace_back(script_.profile);
    }

    Outcome play() {
        for (const Event& event : script_.events) {
            act(event);
            listen();
        }
        wait_for_answers();
        return std::move(outcome_);
    }

  private:
    void act(const Event& event) {
        const auto client = static_cast<std::size_t>(event.client);
        switch (event.kind) {
            case Event::Kind::say:
                listeners_[client].said(event.bytes);
                return shell_.receive(event.bytes, event.client);
            case Event::Kind::wait:
                return shell_.advance_to(shell_.now() + event.time);
            case Event::Kind::boot:
                if (const auto at = shell_.device().reboots_at()) shell_.advance_to(*at);
                return shell_.advance_to(std::max(shell_.now(), shell_.device().booted_at()));
            case Event::Kind::hang_up:
                listeners_[client].forget();
                return shell_.session(event.client).close();
            case Event::Kind::trouble:
                return shell_.device().set_trouble(event.trouble);
            case Event::Kind::power_cycle:
                return shell_.device().boot(shell_.now(), script_.profile.boot_time);
        }
    }

    // Everything due now is done first: what is due after that must lie ahead.
    void listen() {
        shell_.advance_to(shell_.now());
        for (int client = 0; client < script_.clients; ++client) {
            Listener& listener = listeners_[static_cast<std::size_t>(client)];
            for (const Sent& sent : shell_.take_sent(client))
                hear(client, listener, sent);
            for (const Action& action : shell_.take_other_actions(client)) {
                if (std::holds_alternative<DropLink>(action)) listener.forget();
            }
            const auto wake_at = shell_.session(client).wake_at();
            if (wake_at && *wake_at <= shell_.now()) complain(client, "its time stands still");
        }
    }

    void hear(int client, Listener& listener, const Sent& sent) {
        const std::string fault = listener.hear(sent);
        if (!fault.empty()) complain(client, fault + ": " + to_text(sent));
        outcome_.told[static_cast<std::size_t>(client)].push_back(sent);
    }

    void complain(int client, const std::string& fault) {
        if (outcome_.fault.empty())
            outcome_.fault = "client " + std::to_string(client) + ": " + fault;
    }

    // The slowest answers once in 100 ms.
    void wait_for_answers() {
        const auto waiting = [this] {
            return std::ranges::any_of(listeners_,
                                       [](const Listener& l) { return l.unanswered() > 0; });
        };
        std::size_t most = 0;
        for (const Listener& listener : listeners_)
            most = std::max(most, listener.unanswered());
        const Uptime until = shell_.now() + script_.profile.boot_time + script_.profile.wake_time +
                             3s + static_cast<std::int64_t>(most) * 250ms;
        while (waiting() && shell_.now() < until) {
            shell_.advance_to(shell_.now() + 100ms);
            listen();
        }
        for (int client = 0; client < script_.clients; ++client) {
            if (listeners_[static_cast<std::size_t>(client)].unanswered() > 0)
                complain(client, "a request is never answered");
        }
    }

    const Script& script_;
    Shell shell_;
    std::vector<Listener> listeners_;
    Outcome outcome_;
};

}  // namespace

std::string to_text(const Script& script) {
    std::string text = script.profile.name + "@" + script.profile.release;
    if (script.profile.reply_tick == 0s) text += ", ideal";
    if (script.power_up == Script::PowerUp::cold) text += ", found cold";
    if (script.power_up == Script::PowerUp::scip1) text += ", found in SCIP 1.1";
    if (script.clock_wraps) text += ", its clock wraps after a second";
    for (const Event& event : script.events)
        text += "\n  " + to_text(event);
    return text + "\n";
}

std::string to_text(const Sent& message) {
    constexpr std::size_t enough = 200;
    return milliseconds(message.at) + " " + shown(message.bytes.substr(0, enough));
}

Outcome perform(const Script& script) {
    return Performance(script).play();
}

}  // namespace scipd::protocol
