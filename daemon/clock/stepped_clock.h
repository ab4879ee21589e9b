// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The clock of lockstep and of tests. Waits for nothing. Lives on the I/O thread.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "daemon/clock/clock.h"

namespace scipd::daemon {

/// World time that goes on only where it is told to, and calls everything that is due on the way,
/// in the order of time: what happens does not depend on how long anything takes.
class SteppedClock : public Clock {
  public:
    [[nodiscard]] sim::Time now() const override { return now_; }
    [[nodiscard]] sim::Time origin() const override { return origin_; }
    void set_origin(sim::Time origin) { origin_ = origin; }
    [[nodiscard]] std::unique_ptr<Alarm> make_alarm() override;

    void hold(const void* who, bool needed) override;
    [[nodiscard]] bool held() const { return !holders_.empty(); }
    /// Called when nobody holds it any more.
    void on_released(std::function<void()> callback) { on_released_ = std::move(callback); }

    /// Something is to be called some time.
    [[nodiscard]] bool awaited() const { return !queue_.empty(); }
    /// Called when that becomes so.
    void on_awaited(std::function<void()> callback) { on_awaited_ = std::move(callback); }

    /// Calls the first thing that is due until then, at its own time. False: there is none, and it
    /// is that time now.
    bool step(sim::Time until);
    /// Calls what is due until then, in the order of time, whoever holds it; calls may set alarms.
    /// Never goes back.
    void advance_to(sim::Time time);

  private:
    class QueuedAlarm;

    sim::Time now_{};
    sim::Time origin_{};
    std::multimap<sim::Time, QueuedAlarm*> queue_;  ///< of the same time, the one first set first
    std::set<const void*> holders_;
    std::function<void()> on_released_ = [] {};
    std::function<void()> on_awaited_ = [] {};
};

}  // namespace scipd::daemon
