// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Stamps of one sender that leap away from the time: one alone is damaged; where others follow it,
// the sender has been started again or its clock was set. Nothing but values.
#pragma once

#include <chrono>
#include <optional>

#include "sim/time.h"

namespace scipd::daemon {

class StampLeap {
  public:
    /// A stamp this far before the one ahead of it is no late packet.
    static constexpr sim::Time longest_back = std::chrono::seconds(1);
    /// Nobody means a silence longer than this, of which every scan would be made and read.
    static constexpr sim::Time longest_ahead = std::chrono::minutes(10);

    /// One more stamp that leaps. True once they have followed each other for more than a second.
    bool take(sim::Time stamp);
    /// Where that began.
    [[nodiscard]] sim::Time first() const { return first_.value_or(newest_); }
    /// The stamps go on as they did before.
    void forget() { first_ = std::nullopt; }

  private:
    std::optional<sim::Time> first_;
    sim::Time newest_{};
};

}  // namespace scipd::daemon
