// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One direction of what lies between a device and its client: when what is sent at one end is at
// the other, and in which pieces. Two of them share nothing. Neither waits nor moves bytes, and the
// time is handed in.
//
//   send() ─► coalesced ─► cut into pieces ─► one after the other on the line ─► latency ─► take()
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "daemon/config/config.h"
#include "sim/random.h"
#include "sim/time.h"

namespace scipd::daemon {

class LinkModel {
  public:
    /// To be handed over at the other end in one go.
    struct Piece {
        sim::Time at{};  ///< when all of it is there
        std::string bytes;
        int bits_per_second = 0;  ///< of the line that brought it; 0: no serial line
    };

    /// Of chance, the key of the link; the messages are told apart here.
    LinkModel(const LinkConfig& config, const sim::ChanceKey& chance);

    /// Sent at `now`, which never goes back. Nothing overtakes what was sent earlier.
    void send(std::string message, sim::Time now);
    /// The rate of the line from here on. Where it changes a piece without bytes comes out, after
    /// everything earlier.
    void set_rate(int bits_per_second);
    [[nodiscard]] int rate() const { return rate_; }

    /// When to take() again.
    [[nodiscard]] std::optional<sim::Time> next_at() const;
    /// The next piece that is there at `now`.
    [[nodiscard]] std::optional<Piece> take(sim::Time now);
    [[nodiscard]] bool empty() const { return pieces_.empty() && !group_; }
    /// All that is under way.
    [[nodiscard]] std::size_t bytes() const { return bytes_; }
    void clear();

  private:
    /// What waits for more that could leave with it.
    struct Group {
        sim::Time leaves{};
        std::string bytes;
    };

    void leave(std::string message, sim::Time at);
    void end_group();
    [[nodiscard]] std::size_t piece_bytes() const;
    [[nodiscard]] sim::Time time_of(std::size_t bytes) const;
    [[nodiscard]] sim::Time next_delay();

    LinkConfig config_;
    sim::ChanceKey chance_;
    int rate_ = 0;
    std::optional<Group> group_;
    std::deque<Piece> pieces_;
    std::size_t bytes_ = 0;
    sim::Time line_free_ = sim::Time::min();  ///< its last bit has been sent
    sim::Time last_there_ = sim::Time::min();
};

}  // namespace scipd::daemon
