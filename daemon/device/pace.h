// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds sensors whose sweeps are cast more slowly than they are fired, beside those of all other
// sensors on the same thread, and words the warnings for them and for lost scans. One that takes
// longer says nothing, the machine may be busy; some seconds of them do. Reads no clock. One
// thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "sim/time.h"

namespace scipd::daemon {

/// A sweep that was cast.
struct CastSweep {
    std::string_view backend;
    sim::Time period{};  ///< from one sweep to the next
    bool many_poses = false;
    sim::Time due{};    ///< by the same clock as the next two
    sim::Time begin{};  ///< of casting
    sim::Time end{};
};

/// The sweeps of one sensor.
class Pace {
  public:
    /// A sentence for people, once, when for some seconds sweeps have taken longer than they last,
    /// or a good part of it and were late: what casts, how long it takes and what would help.
    std::optional<std::string> add(const CastSweep& sweep);

  private:
    std::string backend_;
    sim::Time begin_{};  ///< of the sweeps that are looked at
    int sweeps_ = 0;     ///< so many
    sim::Time spent_{};  ///< on them
    sim::Time late_{};   ///< in sum
    bool told_ = false;
};

/// All sensors of a thread lose scans together, and get one sentence for that.
class ScanLosses {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Counts lost scans of a sensor. Returns a sentence for people: at once, then every ten
    /// seconds at most, with all that was lost since the one before.
    std::optional<std::string> add(const std::string& sensor, std::uint64_t lost, Time now);

  private:
    std::optional<Time> told_;
    std::set<std::string, std::less<>> sensors_;  ///< that have lost scans since
    std::uint64_t lost_ = 0;                      ///< by all of them
};

}  // namespace scipd::daemon
