// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The world as it is now: the loaded scene, where its robots and movable models are, and the
// backends that cast into it. Changes hands whole: a scene is loaded elsewhere and swapped in.
// Lives on the I/O thread.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/backends/range_backend.h"
#include "sim/time.h"
#include "sim/world/pose.h"
#include "sim/world/pose_track.h"
#include "sim/world/scene.h"

namespace scipd::daemon {

class World {
  public:
    using Backends = std::map<std::string, std::unique_ptr<sim::RangeBackend>, std::less<>>;

    /// Another scene in place of this one, with the backends made for it. Robots stay where they
    /// are, movable models start where the new scene has them.
    void replace_scene(sim::SharedScene scene, Backends backends);
    [[nodiscard]] const sim::Scene& scene() const { return *scene_; }

    /// The robots are these from now on, with where they start; one that was there before stays
    /// where it is unless its start is another now.
    void set_robots(const std::map<std::string, sim::Pose>& world_from_robot);
    /// Null where there is no robot of that name.
    [[nodiscard]] const sim::PoseTrack* robot(std::string_view name) const;

    /// The thing is at this pose at this time; between two poses that follow each other closely it
    /// moves evenly. Returns why not, where it cannot be: no such robot, no such movable model, a
    /// time that is not later than the pose before.
    std::optional<std::string> place_robot(std::string_view name, sim::Time time,
                                           const sim::Pose& world_from_robot);
    /// For senders that name none: fails where there is more than one.
    std::optional<std::string> place_only_robot(sim::Time time, const sim::Pose& world_from_robot);
    std::optional<std::string> place_model(std::string_view name, sim::Time time,
                                           const sim::Pose& world_from_model);

    /// What a name that a user gave stands for: "auto" for one of the others.
    [[nodiscard]] std::string_view backend_name(std::string_view name) const {
        return backends_.find(name)->second->name();
    }
    /// One of those that came with the scene, with every movable model where it is at `time`.
    [[nodiscard]] sim::RangeBackend& backend_at(std::string_view name, sim::Time time);

  private:
    struct Robot {
        sim::Pose start;
        sim::PoseTrack track;
    };

    struct MovableModel {
        sim::ModelId id;
        sim::PoseTrack track;
        sim::Pose placed;  ///< what the backends were told last
    };

    sim::SharedScene scene_;
    std::map<std::string, Robot, std::less<>> robots_;
    std::map<std::string, MovableModel, std::less<>> movable_;
    Backends backends_;
};

}  // namespace scipd::daemon
