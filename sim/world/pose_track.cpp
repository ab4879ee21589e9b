// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/pose_track.h"

#include <algorithm>
#include <cassert>

namespace scipd::sim {
namespace {

/// Of the start pose, which has no time of its own.
constexpr Time ever_since = Time::min();

/// The shortest time there is: what changes within it is a jump.
constexpr Time instant{1};

}  // namespace

PoseTrack::PoseTrack(const Pose& start, std::size_t capacity)
    : entries_{{ever_since, start}}, capacity_(capacity) {
    assert(capacity >= 2);  // a jump takes two
}

bool PoseTrack::append(Time time, const Pose& pose) {
    if (time <= entries_.back().time) return false;
    if (entries_.back().time == ever_since) {
        jump(time, pose);  // nobody knows when the start pose was left
    } else {
        push(time, pose);
    }
    return true;
}

void PoseTrack::jump(Time time, const Pose& pose) {
    const Pose before = at(time - instant);
    while (!entries_.empty() && entries_.back().time >= time - instant)
        entries_.pop_back();
    if (!entries_.empty()) push(time - instant, before);
    push(time, pose);
}

Pose PoseTrack::at(Time time) const {
    const auto after = first_later_than(time);
    if (after == entries_.begin()) return after->pose;
    const auto before = std::prev(after);
    // Equal poses are not interpolated: a robot at rest gives the same pose to the last bit, and
    // the age of the start pose, which does not fit into a Time, is never asked for.
    if (after == entries_.end() || before->pose == after->pose) return before->pose;
    const std::chrono::duration<double> since = time - before->time;
    const std::chrono::duration<double> span = after->time - before->time;
    return interpolate(before->pose, after->pose, since / span);
}

bool PoseTrack::still(Time from, Time to) const {
    auto entry = first_later_than(from);
    if (entry != entries_.begin()) --entry;
    const Pose& held = entry->pose;
    for (; entry != entries_.end(); ++entry) {
        if (entry->pose != held) return false;
        if (entry->time >= to) break;
    }
    return true;
}

PoseTrack::Entries::const_iterator PoseTrack::first_later_than(Time time) const {
    // It is mostly the last moments that are asked for: look there first, then ever farther back.
    std::size_t back = 1;
    while (back < entries_.size() && entries_[entries_.size() - back].time > time)
        back *= 2;
    const auto from = entries_.end() - static_cast<std::ptrdiff_t>(std::min(back, entries_.size()));
    return std::ranges::upper_bound(from, entries_.end(), time, {}, &Entry::time);
}

void PoseTrack::push(Time time, const Pose& pose) {
    entries_.push_back({time, pose});
    if (entries_.size() > capacity_) entries_.pop_front();
}

}  // namespace scipd::sim
