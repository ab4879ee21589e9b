// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <optional>

#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::daemon {

/// Where something is said to be.
struct Placement {
    sim::Time time{};
    sim::Pose pose;
    std::optional<sim::Velocity> velocity;
    /// Said without a time, so that it holds from now on, whatever was said for later.
    bool from_now_on = false;
};

}  // namespace scipd::daemon
