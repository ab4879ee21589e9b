// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/pose_track.h"

#include <algorithm>
#include <cassert>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace scipd::sim {
namespace {

/// The time of the start pose, which has none of its own.
constexpr Time ever_since = Time::min();

using Seconds = std::chrono::duration<double>;

/// The shortest time there is: what changes within it is a jump.
constexpr Time instant{1};

/// Poses of a velocity are this far apart, where there are such: the moments at which closer ones
/// arrive say little.
constexpr Time longest_step = std::chrono::milliseconds(50);

}  // namespace

PoseTrack::PoseTrack(const Pose& start, const PosePolicy& policy, std::size_t capacity)
    : policy_(policy), entries_{{ever_since, start}}, capacity_(capacity) {
    assert(capacity >= 4);  // a jump takes three
}

bool PoseTrack::place(Time time, const Pose& pose, const std::optional<Velocity>& velocity) {
    if (time <= last_time()) return false;
    // In floating point: the start pose may be farther back than a Time can tell.
    const Seconds gap = Seconds(time) - Seconds(last_time());
    const double distance_m = glm::distance(pose.translation_m, last().translation_m);
    const bool one_movement =
        gap <= policy_.longest_gap && distance_m <= policy_.fastest_mps * gap.count();
    if (one_movement) {
        append(time, pose);
    } else {
        jump(time, pose);
    }
    if (velocity) velocity_ = *velocity;
    return true;
}

bool PoseTrack::append(Time time, const Pose& pose) {
    if (time <= last_time()) return false;
    if (!first_time_) {
        jump(time, pose);  // nobody knows when the start pose was left
    } else {
        auto before = std::prev(entries_.end());
        while (before != entries_.begin() && time - before->time < longest_step &&
               before->time - std::prev(before)->time > instant)
            --before;
        velocity_ = velocity_between(before->pose, pose, Seconds(time - before->time).count());
        if (pose == last()) velocity_ = {};
        push(time, pose);
    }
    return true;
}

void PoseTrack::jump(Time time, const Pose& pose) {
    if (!first_time_ || time < *first_time_) first_time_ = time;
    const Pose before = at(time - instant);
    const bool stopped_before = moves_on() && last_time() + policy_.stale_after < time - instant;
    if (stopped_before) push(last_time() + policy_.stale_after, before);
    while (!entries_.empty() && entries_.back().time >= time - instant)
        entries_.pop_back();
    if (!entries_.empty()) push(time - instant, before);
    push(time, pose);
    velocity_ = {};
}

Pose PoseTrack::at(Time time) const {
    const auto after = first_later_than(time);
    if (after == entries_.begin()) return after->pose;
    if (after == entries_.end()) return after_last(time);
    const auto before = std::prev(after);
    // Equal poses are not interpolated: a robot at rest gives the same pose to the last bit, and
    // the age of the start pose, which does not fit into a Time, is never asked for.
    if (before->pose == after->pose) return before->pose;
    const Seconds since = time - before->time;
    const Seconds span = after->time - before->time;
    return interpolate(before->pose, after->pose, since / span);
}

bool PoseTrack::moves_on() const {
    return policy_.after == PosePolicy::After::extrapolate && velocity_ != Velocity{};
}

Pose PoseTrack::after_last(Time time) const {
    if (!moves_on()) return last();
    const Seconds since = std::min(time - last_time(), policy_.stale_after);
    return moved(last(), velocity_, since.count());
}

bool PoseTrack::absent(Time time) const {
    if (!first_time_ || time < *first_time_) return policy_.absent_before;
    if (policy_.after != PosePolicy::After::absent) return false;
    const auto after = first_later_than(time);
    if (after == entries_.begin()) return false;
    const auto before = std::prev(after);
    const bool gap = after == entries_.end() || after->time - before->time > policy_.longest_gap;
    return gap && time - before->time > policy_.stale_after;
}

bool PoseTrack::live(Time time) const {
    return first_time_ && time <= last_time() + policy_.stale_after;
}

bool PoseTrack::still(Time from, Time to) const {
    const bool goes_on = moves_on() && to > last_time() && from < last_time() + policy_.stale_after;
    if (goes_on) return false;
    auto entry = first_later_than(from);
    if (entry != entries_.begin()) --entry;
    const Pose& held = entry->pose;
    for (; entry != entries_.end(); ++entry) {
        if (entry->pose != held) return false;
        if (entry->time >= to) break;
    }
    return true;
}

PoseTrack::Stretch PoseTrack::stretch(Time time) const {
    const auto after = first_later_than(time);
    if (after == entries_.begin()) return {ever_since, after->time, after->pose, {}};
    const Entry& before = *std::prev(after);
    if (after != entries_.end()) {
        const bool rests = before.pose == after->pose;
        const auto velocity = [&] {
            return velocity_between(before.pose, after->pose,
                                    Seconds(after->time - before.time).count());
        };
        return {before.time, after->time, before.pose, rests ? Velocity{} : velocity()};
    }
    if (!moves_on()) return {before.time, Time::max(), before.pose, {}};
    const Time stale = before.time + policy_.stale_after;
    if (time < stale) return {before.time, stale, before.pose, velocity_};
    return {stale, Time::max(), after_last(stale), {}};
}

std::vector<PoseTrack::Leg> PoseTrack::legs(Time from, Time to) const {
    std::vector<Leg> legs;
    auto entry = first_later_than(from);
    if (entry == entries_.begin()) ++entry;  // nothing is known of what was before the first
    for (; entry != entries_.end(); ++entry) {
        const Entry& before = *std::prev(entry);
        if (before.time >= to) return legs;
        if (entry->pose != before.pose && from < to) legs.push_back(leg(before, *entry, from, to));
    }
    if (!moves_on()) return legs;
    const Time begin = std::max(from, last_time());
    const Time end = std::min(to, last_time() + policy_.stale_after);
    if (begin >= end) return legs;
    legs.push_back({begin, end, after_last(begin).translation_m, after_last(end).translation_m,
                    glm::length(velocity_.angular_radps) * Seconds(end - begin).count()});
    return legs;
}

PoseTrack::Leg PoseTrack::leg(const Entry& before, const Entry& after, Time from, Time to) {
    const Time begin = std::max(from, before.time);
    const Time end = std::min(to, after.time);
    const Seconds span = after.time - before.time;
    const auto place_m = [&](Time time) {
        return glm::mix(before.pose.translation_m, after.pose.translation_m,
                        Seconds(time - before.time) / span);
    };
    return {begin, end, place_m(begin), place_m(end),
            angle_between_rad(before.pose.rotation, after.pose.rotation) *
                (Seconds(end - begin) / span)};
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
