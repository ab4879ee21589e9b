// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// World time for everything that waits for it: what time it is, and calls at given times. On the
// wall clock (WallClock) or stepped from outside (SteppedClock); nothing else in the simulation
// reads a clock or sets a timer. One thread.
#pragma once

#include <functional>
#include <memory>

#include "sim/time.h"

namespace scipd::daemon {

class Clock {
  public:
    using Call = std::function<void()>;

    /// One call to come at most. Nothing is called once it is gone; the clock must outlive it.
    class Alarm {
      public:
        Alarm() = default;
        Alarm(const Alarm&) = delete;
        Alarm& operator=(const Alarm&) = delete;
        virtual ~Alarm() = default;

        /// In the place of what was set before. Called as soon as the clock goes on where `at` has
        /// passed already, never from within set().
        virtual void set(sim::Time at, Call call) = 0;
        virtual void cancel() = 0;
    };

    Clock() = default;
    Clock(const Clock&) = delete;
    Clock& operator=(const Clock&) = delete;
    virtual ~Clock() = default;

    [[nodiscard]] virtual sim::Time now() const = 0;
    /// What people and their programs call world time 0: just that, or in lockstep the stamp that
    /// it had. Nothing is reckoned with it, it is added where a time is told.
    [[nodiscard]] virtual sim::Time origin() const { return {}; }
    [[nodiscard]] virtual std::unique_ptr<Alarm> make_alarm() = 0;

    /// Whether `who` needs time to stand still until it says otherwise. No effect where time waits
    /// for nobody.
    virtual void hold(const void* /*who*/, bool /*needed*/) {}
};

}  // namespace scipd::daemon
