// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A model of the world that can move: by poses, by its script, or with the robot whose body it is.
// A value; one thread.
#pragma once

#include <cstddef>

#include "daemon/world/robot.h"
#include "sim/time.h"
#include "sim/world/pose.h"
#include "sim/world/pose_track.h"
#include "sim/world/scene.h"
#include "sim/world/script.h"

namespace scipd::daemon {

struct MovableModel {
    sim::ModelId id;
    sim::Pose start;
    double radius_m;       ///< of all its points around its origin
    sim::PoseTrack track;  ///< its own; a body moves along that of its robot
    sim::SharedScript script;
    sim::Time begun{};    ///< when its script began
    bool placed = false;  ///< a pose has moved it
    const Robot* carrier = nullptr;
    std::size_t place = 0;  ///< among all movable models of the world

    [[nodiscard]] const sim::PoseTrack& path() const {
        return carrier != nullptr ? carrier->track : track;
    }
    [[nodiscard]] bool follows_script() const {
        return script != nullptr && !placed && carrier == nullptr;
    }
    [[nodiscard]] sim::Pose at(sim::Time time) const {
        return follows_script() ? script->at(begun, time) : path().at(time);
    }
};

}  // namespace scipd::daemon
