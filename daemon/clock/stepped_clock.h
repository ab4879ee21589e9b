// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The clock of lockstep and of tests. It waits for nothing. Lives on the I/O thread.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "daemon/clock/clock.h"

namespace scipd::daemon {

/// World time that advances only when told to. On the way it makes every call that is due, in the
/// order of time, so that the result does not depend on how long anything takes.
class SteppedClock : public Clock {
  public:
    [[nodiscard]] sim::Time now() const override { return now_; }
    [[nodiscard]] sim::Time origin() const override { return origin_; }
    void set_origin(sim::Time origin) { origin_ = origin; }
    [[nodiscard]] std::unique_ptr<Alarm> make_alarm() override;
    [[nodiscard]] std::unique_ptr<Alarm> make_idle_alarm() override;
    [[nodiscard]] std::unique_ptr<Alarm> make_slow_alarm(Ahead ahead) override;

    /// `callback` does what it is given, and returns when all of it is done. Without one, each call
    /// does its own.
    using Works = std::vector<const Ahead*>;
    void on_ahead(std::function<void(const Works&)> callback) { on_ahead_ = std::move(callback); }

    void hold(const void* who, bool needed) override;
    [[nodiscard]] bool held() const { return !holders_.empty(); }
    /// The callback runs when the last holder lets go.
    void on_released(std::function<void()> callback) { on_released_ = std::move(callback); }

    /// Whether an alarm is set that is not idle.
    [[nodiscard]] bool awaited() const { return awaited_ > 0; }
    /// The callback runs when the first of those is set.
    void on_awaited(std::function<void()> callback) { on_awaited_ = std::move(callback); }

    /// Makes the first call that is due by `until`, at its own time. False: none is due, and the
    /// time is now `until`.
    bool step(sim::Time until);
    /// Makes all calls that are due by `time`, in the order of time, even if somebody holds the
    /// clock. Calls may set alarms. Time never goes back.
    void advance_to(sim::Time time);

  private:
    class QueuedAlarm;

    void work_ahead();

    sim::Time now_{};
    sim::Time origin_{};
    std::multimap<sim::Time, QueuedAlarm*> queue_;  ///< at equal times in the order they were set
    int awaited_ = 0;                               ///< alarms that are set and not idle
    std::set<const void*> holders_;
    std::function<void(const Works&)> on_ahead_;
    std::function<void()> on_released_ = [] {};
    std::function<void()> on_awaited_ = [] {};
};

}  // namespace scipd::daemon
