// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A thread that does nothing but wake at given instants: how late a program is on this machine that
// has nothing to do. The one who makes it stops it.
#pragma once

#include <chrono>
#include <thread>
#include <vector>

namespace scipd::tools {

class BareTimer {
  public:
    using Clock = std::chrono::steady_clock;

    /// Wakes once in a period, from now on.
    explicit BareTimer(Clock::duration period);

    /// By how much it woke late, from `begin` on, sorted. Stops it.
    [[nodiscard]] std::vector<double> late_ms_since(Clock::time_point begin);

  private:
    struct Waking {
        Clock::time_point due;
        Clock::time_point woke;
    };
    void wake_until_stopped(const std::stop_token& stop, Clock::duration period);

    std::vector<Waking> wakings_;  ///< the thread's, as long as it runs
    std::jthread thread_;
};

}  // namespace scipd::tools
