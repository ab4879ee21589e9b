// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where something in the world is said to be, and what becomes of that. Values; any thread.
#pragma once

#include <optional>

#include "sim/expected.h"
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

/// Why a placement is refused.
struct NotPlaced : sim::Fault {
    enum class Reason {
        unknown,    ///< there is no such thing, or several could be meant
        carried,    ///< it is the body of a robot, and goes where the robot goes
        not_later,  ///< its time is not later than that of the pose before it
    };
    Reason reason = Reason::unknown;
};

using Placed = tl::expected<void, NotPlaced>;

}  // namespace scipd::daemon
