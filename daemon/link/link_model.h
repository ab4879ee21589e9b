// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One direction of the link between a device and its client. Tells when something that is sent at
// one end arrives at the other, and in which pieces. The two directions share nothing. A link model
// neither waits nor moves bytes, and the time is handed in.
//
//   send() ─► coalesced ─► cut into pieces ─► one after the other on the line ─► latency ─► take()
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "daemon/config/link_config.h"
#include "sim/random.h"
#include "sim/time.h"

namespace scipd::daemon {

class LinkModel {
  public:
    /// Bytes that the other end gets in one go.
    struct Piece {
        sim::Time at{};  ///< when all of it is there
        std::string bytes;
        int bits_per_second = 0;  ///< of the line that brought it; 0: no serial line
    };

    /// `chance` is the key of the link; the model itself gives each message a number of its own.
    LinkModel(const LinkConfig& config, const sim::ChanceKey& chance);

    /// Sends a message at `now`, which never goes back. No message overtakes an earlier one.
    void send(std::string message, sim::Time now);
    /// Sets the rate of the line from here on. Where that changes the rate, take() gives a piece
    /// without bytes after everything earlier.
    void set_rate(int bits_per_second);
    /// For what is sent from here on. Where messages take less time now, those that are under way
    /// do so as well.
    void set_config(const LinkConfig& config, sim::Time now);
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
    /// Where the part of a message that begins there ends.
    [[nodiscard]] std::size_t part_end(std::size_t begin, std::size_t size) const;
    /// The most that a serial line brings in one go.
    [[nodiscard]] std::size_t grain_bytes() const;
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
