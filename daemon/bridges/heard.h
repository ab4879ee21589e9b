// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one message of a bus says of where things are, whatever its type and its bytes. Not what it
// means here. Values; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::daemon {

struct HeardPose {
    std::string parent;             ///< the frame that the pose is in; empty: none is said
    std::string child;              ///< what is there, a frame or a model; empty: none is said
    std::uint64_t id = 0;           ///< of Gazebo's entity; 0: none is said
    std::optional<sim::Time> time;  ///< by the sender's clock; nothing: none is said
    sim::Pose parent_from_child;
    std::optional<sim::Velocity> velocity = {};  ///< in the frame of the parent
};

struct Heard {
    std::string type;  ///< "nav_msgs/Odometry"
    std::vector<HeardPose> poses;
    std::optional<sim::Time> clock = {};  ///< time itself, of a message that says nothing else
    bool for_good = false;                ///< holds at all times, as /tf_static does
};

}  // namespace scipd::daemon
