// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Recognises a sender whose stamps leap away from the time. One such stamp alone is damaged. If
// others follow it, the sender was started again or its clock was set. Nothing but values.
#pragma once

#include <chrono>
#include <optional>

#include "sim/time.h"

namespace scipd::daemon {

class StampLeap {
  public:
    /// A stamp that goes back by more than this does not come from a late packet.
    static constexpr sim::Time longest_back = std::chrono::seconds(1);
    /// A stamp that goes on by more than this is not meant: every scan in between would have to be
    /// made and read.
    static constexpr sim::Time longest_ahead = std::chrono::minutes(10);

    /// Takes one more stamp that leaps. True once such stamps have followed each other for more
    /// than a second.
    bool take(sim::Time stamp);
    /// The stamp with which they began.
    [[nodiscard]] sim::Time first() const { return first_.value_or(newest_); }
    /// Called when the stamps go on as before the leap.
    void forget() { first_ = std::nullopt; }

  private:
    std::optional<sim::Time> first_;
    sim::Time newest_{};
};

}  // namespace scipd::daemon
