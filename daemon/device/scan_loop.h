// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Waits for the ends of a source's turns, as long as somebody wants scans. Every instant is
// computed from the number of the revolution and waited for as an absolute time, so lateness never
// adds up.
//
// A machine that was busy for less than a second loses nothing: the turns are served late, one
// right after the other, since with a real scanner the kernel's buffers would have held them. Where
// a turn is later than that, the thread is too slow for its sensors. For a while each of them gives
// up whatever is not the newest then. Whoever has waited longest comes first, so all lose evenly,
// and what they send is new. Lives on its shard.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "daemon/clock/clock.h"
#include "daemon/device/scan_source.h"

namespace scipd::daemon {

class ScanLoop {
  public:
    /// `source`, which lives on this shard, and `clock` must outlive it.
    ScanLoop(ScanSource& source, Clock& clock, std::size_t shard = 0);
    ScanLoop(const ScanLoop&) = delete;
    ScanLoop& operator=(const ScanLoop&) = delete;
    ~ScanLoop();

    /// To be called when poses have come: scans may wait for them.
    void poses_came();

    /// Counts revolutions that a driver waited for, and that were lost because the machine was too
    /// slow or asleep.
    [[nodiscard]] std::uint64_t missed() const { return missed_; }
    /// Counts those that somebody who watches waited for.
    [[nodiscard]] std::uint64_t missed_by_watchers() const { return missed_by_watchers_; }

    /// The turn that it is to end next.
    [[nodiscard]] std::int64_t turn() const { return revolution_; }
    /// Whether it should have gone on by now: what it waits for has come, or somebody wants scans
    /// and it does not wait. Where nobody wants scans, or time stands still, it is not.
    [[nodiscard]] bool overdue() const;

  private:
    void wake();
    void wait(sim::Time until);
    void serve();
    /// Whether serve() may run on another thread now, beside those of other shards.
    [[nodiscard]] bool may_serve_beside() const;
    /// How many turns must be given up where the next one leaves so late.
    [[nodiscard]] std::int64_t too_many(sim::Time late) const;
    void give_up(std::int64_t turns);

    ScanSource& source_;
    Clock& clock_;
    std::unique_ptr<Clock::Alarm> alarm_;
    std::int64_t revolution_ = 0;  ///< the next to be served
    bool waiting_ = false;
    sim::Time until_{};  ///< it waits
    bool lacks_poses_ = false;
    std::uint64_t missed_ = 0;
    std::uint64_t missed_by_watchers_ = 0;
};

}  // namespace scipd::daemon
