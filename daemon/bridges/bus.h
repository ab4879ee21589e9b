// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A bus that is listened to, and who listens. The bus has threads of its own, and calls its
// listener on them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemon/bridges/heard.h"
#include "sim/time.h"

namespace scipd::daemon {

/// Called on a thread of the bus. A call that does not return soon holds up the bus alone.
class BusListener {
  public:
    virtual ~BusListener() = default;

    virtual void hear(Heard message) = 0;
    /// A message was damaged, and why.
    virtual void refuse(std::string why) = 0;
    /// Why nothing can come at present, in a sentence, and what to do; empty: nothing is wrong.
    virtual void tell_trouble(std::string trouble) = 0;
};

/// Listens until it is destroyed. Nobody is called after that.
class Bus {
  public:
    Bus() = default;
    Bus(const Bus&) = delete;
    Bus& operator=(const Bus&) = delete;
    virtual ~Bus() = default;
};

/// What to listen to in ROS 2.
struct RosTopics {
    std::string topic;       ///< "/odom"
    std::string fixed = {};  ///< transforms that hold for good, "/tf_static"; empty: none
    std::string clock = {};  ///< "/clock"; empty: none
};

/// `listener` must outlive the bus. Throws std::runtime_error where there is no network.
std::unique_ptr<Bus> listen_to_ros2(const RosTopics& topics, BusListener& listener);

/// Topics of ROS 1 or 2 by rosbridge. The rosbridge need not be there yet.
std::unique_ptr<Bus> listen_to_rosbridge(const std::string& host, std::uint16_t port,
                                         const RosTopics& topics, BusListener& listener);

/// Topics of Gazebo. `listener` must outlive the bus. Throws std::runtime_error where a name can be
/// that of no topic.
std::unique_ptr<Bus> listen_to_gz(const std::vector<std::string>& topics, BusListener& listener);

}  // namespace scipd::daemon
