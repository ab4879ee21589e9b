// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where frames are in each other, as ROS tells by /tf: each has a parent, and where it is in that
// changes over time. As tf2 has it, where one frame is in another is known up to the latest time to
// which all frames between them are. One thread.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/bridges/heard.h"
#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::daemon {

class FrameTree {
  public:
    /// Where the child is in the parent, from this time on; `for_good`: at all times.
    void put(const HeardPose& pose, bool for_good);

    struct Found {
        sim::Pose parent_from_child;
        std::optional<sim::Time> time;  ///< nothing: it holds for good
    };
    /// Where one frame is in another, which need not be above it. Nothing where no way leads there.
    [[nodiscard]] std::optional<Found> find(std::string_view parent, std::string_view child) const;

    [[nodiscard]] std::set<std::string> names() const;

  private:
    struct Moment {
        sim::Time time{};
        sim::Pose parent_from_child;
    };
    struct Link {
        std::string parent;
        std::deque<Moment> moments;  ///< in the order of time; one: of a link that holds for good
        bool for_good = false;
    };

    [[nodiscard]] std::vector<std::string_view> way_up(std::string_view frame) const;
    [[nodiscard]] const Link& link_of(std::string_view frame) const;
    static sim::Pose at(const Link& link, sim::Time time);

    std::map<std::string, Link, std::less<>> links_;  ///< by the child
};

}  // namespace scipd::daemon
