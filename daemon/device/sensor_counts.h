// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a sensor has done in all its life, in numbers that only grow. Whoever does a thing counts
// it; nobody looks before somebody asks. A value; one thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "daemon/device/lateness.h"
#include "protocol/status_counts.h"

namespace scipd::daemon {

struct CastCount {
    std::uint64_t casts = 0;  ///< sweeps of a scanner, or pictures
    std::chrono::steady_clock::duration spent{};
};

struct SensorCounts {
    std::uint64_t scans = 0;
    std::uint64_t lost = 0;  ///< that drivers did not get
    Lateness lateness;
    std::map<std::string, CastCount, std::less<>> casts;  ///< by backend
    protocol::StatusCounts refused;
    std::uint64_t sent_bytes = 0;
    std::uint64_t faults = 0;  ///< how often those on purpose have acted

    SensorCounts& operator+=(const SensorCounts& other);
};

/// The mean time of a cast, over all backends; nothing: there was none.
[[nodiscard]] std::optional<std::chrono::duration<double>> mean_cast(const SensorCounts& counts);

void add(const protocol::StatusCounts& more, protocol::StatusCounts& counts);

/// Counts one cast: of the time from its making on.
class CastWatch {
  public:
    /// Adds to the count of this backend.
    void stop(const std::string& backend, SensorCounts& counts) const;

  private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace scipd::daemon
