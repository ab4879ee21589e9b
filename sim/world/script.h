// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where a model goes by itself, once or round after round: a pure function of the time since it
// began. Values; any thread.
#pragma once

#include <memory>
#include <vector>

#include "sim/time.h"
#include "sim/world/pose.h"
#include "sim/world/pose_track.h"

namespace scipd::sim {

struct Script {
    /// World from model; between two steps it moves evenly.
    struct Step {
        Time time{};  ///< since it began
        Pose pose;

        bool operator==(const Step&) const = default;
    };

    std::vector<Step> steps;  ///< one at least; the first at time 0, times strictly growing
    Time lap{};               ///< later than the last step: then it begins anew; zero: never

    bool operator==(const Script&) const = default;

    /// Where the model is, if the script began at `begin`.
    [[nodiscard]] Pose at(Time begin, Time time) const;
    /// Right from one time to the other, and with no more poses than that takes.
    [[nodiscard]] PoseTrack between(Time begin, Time from, Time to) const;
};

using SharedScript = std::shared_ptr<const Script>;

/// The script for a walk in a frame that lies so in the world.
SharedScript moved(const Pose& world_from_frame, const Script& script);

}  // namespace scipd::sim
