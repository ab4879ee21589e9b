// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The dullest possible shell around sessions of one device: turns the clock by hand, hands in
// synthetic scans and keeps what is sent, each message with its instant. The mirror turns as the
// device's settings have it; a scan leaves on the reply grid after its last step, as the scanner
// that it stands for would send it.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "protocol/session.h"

namespace scipd::protocol {

struct Sent {
    Uptime at{};
    std::string bytes;
    Send::Kind kind = Send::Kind::reply;

    bool operator==(const Sent&) const = default;
};

class Shell {
  public:
    /// `device`: as it is at 0.
    explicit Shell(DeviceProfile profile, int clients = 1, DeviceState device = {});

    /// The client's bytes come in at now().
    void receive(std::string_view bytes, int client = 0);
    /// Does everything that is due until then, in the order of time; scans before replies of the
    /// same instant.
    void advance_to(Uptime time);

    [[nodiscard]] Uptime now() const { return now_; }
    [[nodiscard]] Session& session(int client = 0) { return *sessions_[client]; }
    [[nodiscard]] DeviceState& device() {
        catch_up();
        return device_;
    }
    /// All that has been sent since the last call.
    std::vector<Sent> take_sent(int client = 0);
    /// What it was asked to do besides sending since the last call.
    std::vector<Action> take_other_actions(int client = 0);
    /// What take_sent() takes, as one string.
    std::string take_text(int client = 0);

    /// What the scanner sees at a step.
    std::function<std::uint32_t(int step)> distance = [](int) { return 1000; };
    std::function<std::uint32_t(int step)> intensity = [](int) { return 500; };
    /// All that comes back from it; empty: the one above.
    std::function<StepEchoes(int step)> echoes;
    int scans_made = 0;

  private:
    struct MirrorTurn {
        Uptime start{};
        Uptime period{};
    };
    struct Leaving {
        int client;
        Turn turn;
        Uptime at;
    };

    [[nodiscard]] Uptime complete(const MirrorTurn& turn) const;
    [[nodiscard]] MirrorTurn following(const MirrorTurn& turn) const;
    [[nodiscard]] Uptime next_event();
    [[nodiscard]] int clients() const { return static_cast<int>(sessions_.size()); }
    void catch_up();
    void complete_turn();
    void hand_out(int client, const Turn& turn);
    void settle(int client);

    DeviceProfile profile_;
    DeviceState device_;
    std::vector<std::unique_ptr<Session>> sessions_;
    std::vector<std::vector<Sent>> sent_;
    std::vector<std::vector<Action>> other_actions_;
    std::deque<Leaving> leaving_;
    MirrorTurn done_;  ///< the latest that has been completed
    Uptime now_{};
};

}  // namespace scipd::protocol
