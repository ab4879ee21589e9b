// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The tree that the joints of a URDF robot make of its links. Any thread; nothing shared.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <tinyxml2.h>

#include "sim/world/pose.h"

namespace scipd::sim {

/// Called with a joint and what is wrong with it.
using Wrong = std::function<void(const tinyxml2::XMLElement& element, const std::string& what)>;

/// Reads xyz and rpy of an <origin>. What cannot be read is 0 0 0, and told to `faults`.
Pose pose_of_origin(const tinyxml2::XMLElement* origin, std::vector<std::string>& faults);

class UrdfTree {
  public:
    /// Leaves out joints that make no tree. `links` are the names of all.
    UrdfTree(const tinyxml2::XMLElement& robot, const std::set<std::string>& links,
             const Wrong& wrong);

    struct Hung {
        std::string parent;
        Pose parent_from_here;
        bool is_lost = false;  ///< the pose cannot be read
    };
    /// What a link hangs on; null if on nothing.
    [[nodiscard]] const Hung* above(const std::string& link) const;
    /// Whether nobody knows where it is: the pose of its joint, or of one above, cannot be read.
    [[nodiscard]] bool is_lost(std::string link) const;

  private:
    [[nodiscard]] std::string fault_of(const tinyxml2::XMLElement& joint,
                                       const std::set<std::string>& links) const;

    std::map<std::string, Hung> above_;
};

}  // namespace scipd::sim
