// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <map>
#include <memory>

#include "daemon/device/clock.h"

namespace scipd::daemon {

/// World time that goes on only where it is told to, and calls everything that is due on the way,
/// in the order of time: what happens does not depend on how long anything takes.
class SteppedClock : public Clock {
  public:
    [[nodiscard]] sim::Time now() const override { return now_; }
    [[nodiscard]] std::unique_ptr<Alarm> make_alarm() override;

    /// Calls what is due until then, each at its own time; calls may set alarms. Never goes back.
    void advance_to(sim::Time time);

  private:
    class QueuedAlarm;

    sim::Time now_{};
    std::multimap<sim::Time, QueuedAlarm*> queue_;  ///< of the same time, the one first set first
};

}  // namespace scipd::daemon
