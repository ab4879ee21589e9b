// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A place for a sensor that the user has named instead of measured. Only the loaded world tells
// where it is (daemon/mounting.h). Plain values.
#pragma once

#include <string>

#include "sim/world/pose.h"

namespace scipd::daemon {

/// What of a world a name may be of.
enum class MountKind {
    any,
    link,    ///< or a frame
    sensor,  ///< of any type
    lidar,
};

struct NamedMount {
    MountKind kind = MountKind::any;
    std::string name;             ///< whole, MODEL::LINK::SENSOR, or its end
    sim::Pose frame_from_sensor;  ///< how far from there
    bool chooses_model = false;   ///< the product that fits the lidar there best takes its place
    std::string model;            ///< of the world, that the place lies in; empty: not known yet

    bool operator==(const NamedMount&) const = default;
};

}  // namespace scipd::daemon
