// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/bridges/frame_tree.h"

#include <algorithm>
#include <chrono>
#include <iterator>

namespace scipd::daemon {
namespace {

// As long as tf2 remembers by default (tf2::BUFFER_CORE_DEFAULT_CACHE_TIME).
constexpr sim::Time remembered = std::chrono::seconds(10);
// A transform that comes later than this is no late packet: its sender was started again.
constexpr sim::Time longest_back = std::chrono::seconds(1);
constexpr std::size_t most_moments = 20'000;
constexpr std::size_t most_links = 10'000;
// Nobody nests frames so deeply; a circle of them ends here.
constexpr std::size_t longest_way = 1000;

/// Names of ROS 1 may begin with a slash.
std::string_view plain(std::string_view frame) {
    return frame.starts_with('/') ? frame.substr(1) : frame;
}

}  // namespace

void FrameTree::put(const HeardPose& pose, bool for_good) {
    if (links_.size() >= most_links && !links_.contains(plain(pose.child))) return;
    Link& link = links_[std::string(plain(pose.child))];
    const Moment moment{pose.time.value_or(sim::Time{}), pose.parent_from_child};
    auto& moments = link.moments;
    const bool starts_over = !moments.empty() && moments.back().time - moment.time > longest_back;
    if (for_good || link.for_good || link.parent != plain(pose.parent) || starts_over)
        moments.clear();
    link.parent = plain(pose.parent);
    link.for_good = for_good;
    const auto later = std::ranges::lower_bound(moments, moment.time, {}, &Moment::time);
    if (later != moments.end() && later->time == moment.time) {
        *later = moment;
    } else {
        moments.insert(later, moment);
    }
    while (moments.size() > most_moments || moments.back().time - moments.front().time > remembered)
        moments.pop_front();
}

std::vector<std::string_view> FrameTree::way_up(std::string_view frame) const {
    std::vector<std::string_view> way{frame};
    for (auto link = links_.find(frame); link != links_.end() && way.size() < longest_way;
         link = links_.find(way.back()))
        way.push_back(link->second.parent);
    return way;
}

const FrameTree::Link& FrameTree::link_of(std::string_view frame) const {
    return links_.find(frame)->second;
}

sim::Pose FrameTree::at(const Link& link, sim::Time time) {
    const auto& moments = link.moments;
    const auto later = std::ranges::lower_bound(moments, time, {}, &Moment::time);
    if (link.for_good || later == moments.begin()) return moments.front().parent_from_child;
    if (later == moments.end()) return moments.back().parent_from_child;
    const Moment& before = *std::prev(later);
    const double share = std::chrono::duration<double>(time - before.time) /
                         std::chrono::duration<double>(later->time - before.time);
    return sim::interpolate(before.parent_from_child, later->parent_from_child, share);
}

std::optional<FrameTree::Found> FrameTree::find(std::string_view parent,
                                                std::string_view child) const {
    auto down = way_up(plain(child));
    auto up = way_up(plain(parent));
    const auto meeting = std::ranges::find_first_of(down, up);
    if (meeting == down.end()) return std::nullopt;
    up.erase(std::ranges::find(up, *meeting), up.end());
    down.erase(meeting, down.end());
    std::optional<sim::Time> time;
    for (const auto* const way : {&down, &up}) {
        for (const std::string_view frame : *way) {
            const Link& link = link_of(frame);
            if (!link.for_good)
                time = std::min(time.value_or(sim::Time::max()), link.moments.back().time);
        }
    }
    sim::Pose meeting_from_child;
    for (const std::string_view frame : down)
        meeting_from_child = at(link_of(frame), time.value_or(sim::Time{})) * meeting_from_child;
    sim::Pose meeting_from_parent;
    for (const std::string_view frame : up)
        meeting_from_parent = at(link_of(frame), time.value_or(sim::Time{})) * meeting_from_parent;
    return Found{inverse(meeting_from_parent) * meeting_from_child, time};
}

std::set<std::string> FrameTree::names() const {
    std::set<std::string> names;
    for (const auto& [child, link] : links_) {
        names.insert(child);
        names.insert(link.parent);
    }
    return names;
}

}  // namespace scipd::daemon
