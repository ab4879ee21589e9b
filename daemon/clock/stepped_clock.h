// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The clock of lockstep and of tests. It waits for nothing. Lives on the I/O thread; what calls ask
// of it that are made side by side they may ask on any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <utility>
#include <vector>

#include "daemon/clock/clock.h"

namespace scipd::daemon {

/// World time that advances only when told to. On the way it makes every call that is due, in the
/// order of time, so that the result does not depend on how long anything takes. The threads that
/// make calls side by side change nothing about it either: alarms that those set are in the order
/// of the calls.
class SteppedClock : public Clock {
  public:
    [[nodiscard]] sim::Time now() const override { return now_; }
    [[nodiscard]] sim::Time origin() const override { return origin_; }
    void set_origin(sim::Time origin) { origin_ = origin; }
    [[nodiscard]] std::unique_ptr<Alarm> make_alarm() override;
    [[nodiscard]] std::unique_ptr<Alarm> make_idle_alarm() override;
    [[nodiscard]] std::unique_ptr<Alarm> make_slow_alarm(Beside beside) override;

    struct SlowCall {
        std::size_t shard = 0;
        Call call;
    };
    /// `callback` makes calls of several shards, those of one shard one after the other, and
    /// returns when all are made. Without one, none are made side by side.
    using MakeBeside = std::function<void(const std::vector<SlowCall>&)>;
    void on_beside(MakeBeside callback) { make_beside_ = std::move(callback); }

    /// The callback runs before each step: for those who keep something until somebody looks at it.
    void on_step(std::function<void()> callback) { on_step_ = std::move(callback); }

    void hold(const void* who, bool needed) override;
    [[nodiscard]] bool held() const { return !holders_.empty(); }
    /// The callback runs when the last holder lets go.
    void on_released(std::function<void()> callback) { on_released_ = std::move(callback); }

    /// Whether an alarm is set that is not idle.
    [[nodiscard]] bool awaited() const { return awaited_ > 0; }
    /// The callback runs when the first of those is set.
    void on_awaited(std::function<void()> callback) { on_awaited_ = std::move(callback); }

    /// Makes the first call that is due by `until`, at its own time, and those that are made beside
    /// it. Returns how many it made; 0: none is due, and the time is now `until`.
    std::size_t step(sim::Time until);
    /// Makes all calls that are due by `time`, in the order of time, even if somebody holds the
    /// clock. Calls may set alarms. Time never goes back.
    void advance_to(sim::Time time);

  private:
    class QueuedAlarm;
    /// The time, and at equal times the order in which they were set.
    using Place = std::pair<sim::Time, std::uint64_t>;

    [[nodiscard]] Place next_place(sim::Time at);
    void enter(const Place& place, QueuedAlarm& alarm, int counts);
    void leave(const Place& place, int counts);
    [[nodiscard]] std::vector<QueuedAlarm*> due_side_by_side() const;
    void call_side_by_side(const std::vector<QueuedAlarm*>& alarms);

    sim::Time now_{};
    sim::Time origin_{};
    MakeBeside make_beside_;
    std::function<void()> on_step_ = [] {};
    std::uint64_t next_order_ = 0;
    bool side_by_side_ = false;  ///< right now

    std::mutex mutex_;  ///< calls that are made side by side change the three below
    std::map<Place, QueuedAlarm*> queue_;
    int awaited_ = 0;  ///< alarms that are set and not idle
    std::set<const void*> holders_;
    std::function<void()> on_released_ = [] {};
    std::function<void()> on_awaited_ = [] {};
};

}  // namespace scipd::daemon
