// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Tells people, now and then, that this machine is too slow for all that its sensors are to cast.
// All of them lose scans then, so it has one sentence for all. Reads no clock. One thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

namespace scipd::daemon {

class ScanLosses {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// So many scans of this sensor are lost. A sentence for people: at once, then every ten
    /// seconds at most, with all that was lost since the one before.
    std::optional<std::string> add(const std::string& sensor, std::uint64_t lost, Time now);

  private:
    std::optional<Time> told_;
    std::set<std::string, std::less<>> sensors_;  ///< that have lost scans since
    std::uint64_t lost_ = 0;                      ///< by all of them
};

}  // namespace scipd::daemon
