// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Who publishes what in ROS 2, and what to listen to it as. One thread.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace scipd::daemon {

/// One who publishes.
struct RosOffer {
    std::string topic;     ///< as ROS 2 names it, "/odom"
    std::string dds_type;  ///< "nav_msgs::msg::dds_::Odometry_"
    bool reliable = false;
    bool keeps_last = false;  ///< for those who come later

    bool operator==(const RosOffer&) const = default;
};

class RosOffers {
  public:
    /// One who publishes is known by the key. Whether this is news.
    bool add(const std::string& key, const RosOffer& offer);
    bool remove(const std::string& key) { return offers_.erase(key) > 0; }

    /// What all can do who publish the topic as one type: a reader that wants more hears nothing
    /// of some of them. Nothing where no readable type is published.
    [[nodiscard]] std::optional<RosOffer> common(const std::string& topic) const;

    /// Why nothing comes by this topic, and which there are; empty: it can come.
    [[nodiscard]] std::string trouble_with(const std::string& topic) const;

  private:
    std::map<std::string, RosOffer> offers_;
};

}  // namespace scipd::daemon
