// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The poses of one moving thing over time. Not a filter and not a predictor: between two poses it
// interpolates, before the first and after the last it holds. Owned by the thread that feeds it;
// what leaves are values.
#pragma once

#include <cstddef>
#include <deque>

#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::sim {

class PoseTrack {
  public:
    /// The start pose holds until the first one that is appended. Keeps at most `capacity` poses,
    /// two or more: the oldest go first.
    explicit PoseTrack(const Pose& start, std::size_t capacity = 4096);

    /// False, and nothing changes, where `time` is not later than the last pose's.
    bool append(Time time, const Pose& pose);

    /// From `time` on the pose is this one, wherever it was before: no interpolation across the
    /// jump, and what was appended for later is forgotten.
    void jump(Time time, const Pose& pose);

    [[nodiscard]] Pose at(Time time) const;
    [[nodiscard]] const Pose& last() const { return entries_.back().pose; }
    /// Of last(); the least of all times where that is the start pose.
    [[nodiscard]] Time last_time() const { return entries_.back().time; }

    /// Whether the pose is the same at every time between the two: one pose then serves a whole
    /// sweep.
    [[nodiscard]] bool still(Time from, Time to) const;

  private:
    struct Entry {
        Time time;
        Pose pose;
    };
    using Entries = std::deque<Entry>;

    [[nodiscard]] Entries::const_iterator first_later_than(Time time) const;
    void push(Time time, const Pose& pose);

    Entries entries_;  ///< never empty, times strictly growing
    std::size_t capacity_;
};

}  // namespace scipd::sim
