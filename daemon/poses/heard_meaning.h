// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the messages of a bus mean for the robots and models here. Lives on the I/O thread.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemon/bridges/heard.h"
#include "daemon/config/config.h"
#include "daemon/world/world.h"
#include "sim/loaders/poses/pose_line.h"
#include "sim/time.h"

namespace scipd::daemon {

class HeardMeaning {
  public:
    /// What a message says, in the order of time.
    struct Said {
        std::optional<sim::Time> until;  ///< all is said up to this time of the sender
        std::vector<sim::PoseLine> lines;
    };

    virtual ~HeardMeaning() = default;

    /// `robot` is the one that the source is for.
    [[nodiscard]] virtual Said take(const Heard& message, const std::string& robot,
                                    const World& world) = 0;
    /// What was looked for in the messages and is not in them, with the names that are: a sentence
    /// each.
    [[nodiscard]] virtual std::vector<std::string> troubles(const std::string& robot,
                                                            const World& world) const = 0;
    /// Whether the models of the world are moved, too.
    virtual void move_models(bool /*yes*/) {}
};

/// The robot, and all models if it moves them, by their names in Gazebo. What Gazebo calls the
/// robot: empty: as its body, else as itself.
std::unique_ptr<HeardMeaning> make_gz_meaning(const std::string& called);

/// A robot is one frame of ROS, or what the only pose of each message is of.
std::unique_ptr<HeardMeaning> make_ros_meaning(const RosFrames& frames);

}  // namespace scipd::daemon
