// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The poses of one moving thing over time. Not a filter: between two poses of one movement it
// interpolates; what it assumes where it knows none is its policy. Owned by the thread that feeds
// it; what leaves are values.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::sim {

/// What is assumed where no pose is known.
struct PosePolicy {
    enum class After {
        hold,         ///< it stays there
        extrapolate,  ///< it goes on as it moved, until the stream is stale; then it stays there
        absent,       ///< it stays there until the stream is stale; then it is nowhere
    };
    bool absent_before = false;  ///< until the first pose; else it is at its start
    After after = After::hold;
    Time stale_after = std::chrono::milliseconds(500);

    /// Poses farther apart in time do not belong to one movement, nor do those that nothing can
    /// move between so fast: the thing rests and then is somewhere else. Nothing is seen from
    /// within a wall that lies between them.
    Time longest_gap = std::chrono::seconds(1);
    double fastest_mps = 20.0;

    bool operator==(const PosePolicy&) const = default;
};

class PoseTrack {
  public:
    /// The start pose holds until the first one that is appended. Keeps at most `capacity` poses,
    /// four or more: the oldest go first.
    explicit PoseTrack(const Pose& start, const PosePolicy& policy = {},
                       std::size_t capacity = 4096);

    /// It is there at that time: moved there from the pose before, or jumped, as the policy has it.
    /// Extrapolation goes on with `velocity`, or without with that from the pose before. False, and
    /// nothing changes, where `time` is not later than the last pose's.
    bool place(Time time, const Pose& pose, const std::optional<Velocity>& velocity = {});

    /// The same, however far away: it has moved there from the pose before.
    bool append(Time time, const Pose& pose);

    /// From `time` on the pose is this one, wherever it was before: no interpolation across the
    /// jump, and what was appended for later is forgotten.
    void jump(Time time, const Pose& pose);

    [[nodiscard]] Pose at(Time time) const;
    /// The policy has it nowhere then; at() tells where it was last.
    [[nodiscard]] bool absent(Time time) const;
    [[nodiscard]] const Pose& last() const { return entries_.back().pose; }
    /// Of last(); the least of all times where that is the start pose.
    [[nodiscard]] Time last_time() const { return entries_.back().time; }
    /// Poses have come, and the last one is not stale.
    [[nodiscard]] bool live(Time time) const;

    /// Whether the pose is the same at every time between the two: one pose then serves a whole
    /// sweep.
    [[nodiscard]] bool still(Time from, Time to) const;

    /// On the way from one place to another, evenly. One of a nanosecond is a jump.
    struct Leg {
        Time begin{};
        Time end{};  ///< later
        glm::dvec3 from_m{0.0};
        glm::dvec3 to_m{0.0};
        double turned_rad = 0.0;  ///< more than half a turn where it goes on by itself
    };
    /// All between the two times, in order; at all other times the pose stays what it is.
    [[nodiscard]] std::vector<Leg> legs(Time from, Time to) const;

  private:
    struct Entry {
        Time time;
        Pose pose;
    };
    using Entries = std::deque<Entry>;

    [[nodiscard]] Entries::const_iterator first_later_than(Time time) const;
    [[nodiscard]] bool moves_on() const;
    [[nodiscard]] Pose after_last(Time time) const;
    [[nodiscard]] static Leg leg(const Entry& before, const Entry& after, Time from, Time to);
    void push(Time time, const Pose& pose);

    PosePolicy policy_;
    Entries entries_;  ///< never empty, times strictly growing
    std::size_t capacity_;
    std::optional<Time> first_time_;  ///< of the first pose but the start
    Velocity velocity_;               ///< at the last pose
};

}  // namespace scipd::sim
