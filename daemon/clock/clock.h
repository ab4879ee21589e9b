// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// World time for everything that waits for it: it tells the time and calls back at given times. It
// is the wall clock (WallClock) or is stepped from outside (SteppedClock). Nothing else in the
// simulation reads a clock or sets a timer. One thread.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "sim/time.h"

namespace scipd::daemon {

class Clock {
  public:
    using Call = std::function<void()>;

    /// Holds at most one pending call. Once the alarm is destroyed nothing is called. The clock
    /// must outlive it.
    class Alarm {
      public:
        Alarm() = default;
        Alarm(const Alarm&) = delete;
        Alarm& operator=(const Alarm&) = delete;
        virtual ~Alarm() = default;

        /// Replaces the call that was set before. If `at` has already passed, the call comes as
        /// soon as the clock goes on, never from within set().
        virtual void set(sim::Time at, Call call) = 0;
        virtual void cancel() = 0;
    };

    Clock() = default;
    Clock(const Clock&) = delete;
    Clock& operator=(const Clock&) = delete;
    virtual ~Clock() = default;

    [[nodiscard]] virtual sim::Time now() const = 0;
    /// What people and their programs call world time 0. It is 0 itself, or in lockstep the stamp
    /// of that moment. The daemon does not calculate with it. It adds it when it reports a time.
    [[nodiscard]] virtual sim::Time origin() const { return {}; }
    /// What to add now to a time that is reported, for Unix time. 0 in lockstep: the stamps are the
    /// time, whatever they count from.
    [[nodiscard]] virtual sim::Time unix_origin() const { return {}; }
    [[nodiscard]] virtual std::unique_ptr<Alarm> make_alarm() = 0;
    /// For a call that is made on the way, and that nobody waits for: a clock that goes on only as
    /// long as somebody waits does not go on for this.
    [[nodiscard]] virtual std::unique_ptr<Alarm> make_idle_alarm() { return make_alarm(); }

    /// Whether a call may be made on another thread, beside calls of other shards.
    struct Beside {
        std::size_t shard = 0;
        std::function<bool()> may = nullptr;  ///< asked when it is due; null: never
    };
    /// For calls that take long: where others wait as well, what is short comes first. A clock that
    /// waits for nothing makes those side by side that follow each other at one time.
    [[nodiscard]] virtual std::unique_ptr<Alarm> make_slow_alarm(Beside /*beside*/) {
        return make_alarm();
    }

    /// Whether somebody who waits for it has lately found its thread too slow for all who do.
    [[nodiscard]] bool overloaded() const { return now() < overloaded_until_; }
    void set_overloaded_until(sim::Time until) { overloaded_until_ = until; }

    /// With `needed`, `who` needs time to stand still until it calls hold() without. A clock that
    /// waits for nobody ignores this.
    virtual void hold(const void* /*who*/, bool /*needed*/) {}

  private:
    sim::Time overloaded_until_ = sim::Time::min();
};

}  // namespace scipd::daemon
