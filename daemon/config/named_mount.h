// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A place for a sensor that the user has said by its name and not by numbers. Only the loaded world
// tells where that is (daemon/plan/mounting.h). Plain values.
#pragma once

#include <string>

#include "sim/world/pose.h"

namespace scipd::daemon {

/// What kind of thing in a world has the name.
enum class MountKind {
    any,
    link,    ///< or a frame
    sensor,  ///< of any type
    lidar,
};

struct NamedMount {
    MountKind kind = MountKind::any;
    std::string name;             ///< MODEL::LINK::SENSOR, or the end of that
    sim::Pose frame_from_sensor;  ///< from the named place
    bool chooses_model = false;   ///< the sensor becomes the product that fits the lidar there best
    std::string model;  ///< the world's model in which the place lies; empty: not known yet
    std::string link;   ///< of that model: the one that carries the place, MODEL::LINK, or empty

    bool operator==(const NamedMount&) const = default;
};

}  // namespace scipd::daemon
