// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The poses of one moving thing over time. A track is not a filter: it interpolates between two
// poses of one movement. Its policy says what holds before the first and after the last pose. The
// thread that feeds a track owns it. Others get values.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::sim {

/// Where a thing is at times for which no pose has come.
struct PosePolicy {
    /// What it does after its last pose. The stream of poses is stale when none has come for
    /// `stale_after`.
    enum class After {
        hold,         ///< it stays where it is
        extrapolate,  ///< it keeps its velocity until the stream is stale, and then stays
        absent,       ///< it stays until the stream is stale, and then is nowhere
    };
    /// Whether it is nowhere before its first pose. Otherwise it stands at its start.
    bool absent_before = false;
    After after = After::hold;
    Time stale_after = std::chrono::milliseconds(500);

    /// Two poses belong to one movement if they are at most `longest_gap` apart, and if the thing
    /// needs at most `fastest_mps` from one to the other. Otherwise it rests at the first and
    /// jumps to the second. Nothing is interpolated then, so a scanner never looks out from inside
    /// a wall that stands between the two.
    Time longest_gap = std::chrono::seconds(1);
    double fastest_mps = 20.0;

    bool operator==(const PosePolicy&) const = default;
};

class PoseTrack {
  public:
    /// The thing has the start pose until the first one is added. The track keeps at most
    /// `capacity` poses, which must be four or more, and drops the oldest first.
    explicit PoseTrack(const Pose& start, const PosePolicy& policy = {},
                       std::size_t capacity = 4096);

    /// Adds a pose. The policy decides whether the thing moved or jumped there from the pose
    /// before. Extrapolation uses `velocity`; without it, the velocity from the pose before.
    /// Returns false and changes nothing if `time` is not later than that of the last pose.
    bool place(Time time, const Pose& pose, const std::optional<Velocity>& velocity = {});

    /// As place(), but the thing always moved there, however far away it is.
    bool append(Time time, const Pose& pose);

    /// From `time` on the thing is at `pose`. It jumps there, so nothing is interpolated. Poses
    /// that were added for later times are dropped.
    void jump(Time time, const Pose& pose);

    [[nodiscard]] Pose at(Time time) const;
    /// Whether the thing is nowhere at this time, by the policy. at() tells where it was last.
    [[nodiscard]] bool absent(Time time) const;
    [[nodiscard]] const Pose& last() const { return entries_.back().pose; }
    /// The time of last(). For the start pose this is the smallest value of Time.
    [[nodiscard]] Time last_time() const { return entries_.back().time; }
    /// Whether a pose has been added and the stream is not stale.
    [[nodiscard]] bool live(Time time) const;

    /// Whether the pose does not change between the two times. If so, one pose serves a whole
    /// sweep.
    [[nodiscard]] bool still(Time from, Time to) const;

    /// A time during which the thing rests or moves evenly: at `time` it is at
    /// moved(from, velocity, time - begin).
    struct Stretch {
        Time begin{};
        Time end{};  ///< later; from then on something else holds
        Pose from;
        Velocity velocity;
    };
    /// The one that holds at `time`.
    [[nodiscard]] Stretch stretch(Time time) const;

    /// A movement at constant velocity. A leg that takes one nanosecond is a jump.
    struct Leg {
        Time begin{};
        Time end{};  ///< later
        glm::dvec3 from_m{0.0};
        glm::dvec3 to_m{0.0};
        double turned_rad = 0.0;  ///< more than half a turn only where it is extrapolated
    };
    /// All legs between the two times, in order. The pose does not change at any other time.
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
    Entries entries_;  ///< never empty; each is later than the one before
    std::size_t capacity_;
    std::optional<Time> first_time_;  ///< of the first pose after the start pose
    Velocity velocity_;               ///< at the last pose
};

}  // namespace scipd::sim
