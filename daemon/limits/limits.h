// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The limits that hold now, and how often each has refused something. All who hold clients to a
// limit share it. Any thread; the limits are set while no other thread looks at them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "daemon/limits/limit.h"
#include "daemon/limits/throttle.h"

namespace scipd::daemon {

class Limits {
  public:
    explicit Limits(const LimitValues& values = {}) : values_(values) {}

    /// For all that comes from now on.
    void set(const LimitValues& values) { values_ = values; }
    [[nodiscard]] const LimitValues& values() const { return values_; }
    [[nodiscard]] std::size_t operator[](Limit limit) const {
        return static_cast<std::size_t>(values_[limit]);
    }

    /// Counts that somebody wanted more, and tells the log, but not each time. `who` is the client
    /// or the place, as the log calls it. Returns what beyond() says.
    std::string refuse(Limit limit, std::string_view who);
    [[nodiscard]] std::uint64_t refused(Limit limit) const {
        const std::lock_guard lock(mutex_);
        return refused_[place_of(limit)];
    }

  private:
    LimitValues values_;
    mutable std::mutex mutex_;  ///< of what follows
    std::array<std::uint64_t, limit_table.size()> refused_{};
    std::array<Throttle, limit_table.size()> told_;
};

/// Connections may end after the daemon.
using SharedLimits = std::shared_ptr<Limits>;

}  // namespace scipd::daemon
