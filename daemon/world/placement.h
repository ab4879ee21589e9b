// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <optional>

#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::daemon {

/// A sender says that a robot or a model is at this pose.
struct Placement {
    sim::Time time{};
    sim::Pose pose;
    std::optional<sim::Velocity> velocity;
    /// The sender gave no time. The pose holds from now on and replaces poses of later times.
    bool from_now_on = false;
};

}  // namespace scipd::daemon
