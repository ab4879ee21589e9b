// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The world as it is now: the loaded scene, where its robots and movable models are, and the
// backends that cast into it. Changes hands whole: a scene is loaded elsewhere and swapped in.
// Lives on the I/O thread.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "daemon/world/cast.h"
#include "daemon/world/placement.h"
#include "daemon/world/sensor_backends.h"
#include "sim/backends/range_backend.h"
#include "sim/time.h"
#include "sim/world/mover.h"
#include "sim/world/pose.h"
#include "sim/world/pose_track.h"
#include "sim/world/scene.h"
#include "sim/world/script.h"

namespace scipd::daemon {

/// A robot as it is configured.
struct RobotStart {
    sim::Pose world_from_robot;  ///< where it starts
    sim::PosePolicy policy;
    std::string body;  ///< the movable model that moves with it; empty: it has none

    bool operator==(const RobotStart&) const = default;
};

class World {
  public:
    /// Why a pose is refused whose time lies before what is known already.
    static constexpr std::string_view not_later = "t: not later than the pose before it";

    /// Another scene in place of this one, with the backends made for it. Robots stay where they
    /// are; movable models start where the new scene has them, and begin their scripts now, unless
    /// they were there before, started at the same place and are not placed anew. Answers with the
    /// backends of before, which are bound to no thread.
    SensorBackends replace_scene(sim::SharedScene scene, SensorBackends backends,
                                 const std::set<std::string>& placed_anew = {}, sim::Time now = {});
    /// Others for the same scene.
    SensorBackends replace_backends(SensorBackends backends);
    [[nodiscard]] const sim::SharedScene& scene() const { return scene_; }
    /// For those who keep what was seen of it, and not the memory that it takes.
    [[nodiscard]] const sim::SharedScene& names() const { return names_; }

    /// The robots are these from now on; one that was there before stays where it is unless it is
    /// configured otherwise now.
    void set_robots(const std::map<std::string, RobotStart>& robots);
    /// Null where there is no robot of that name.
    [[nodiscard]] const sim::PoseTrack* robot(std::string_view name) const;
    /// Null where there is no movable model of that name. A body is where its robot is; of one that
    /// follows its script nothing has been said.
    [[nodiscard]] const sim::PoseTrack* model(std::string_view name) const;
    /// Wherever it is by whatever moves it.
    [[nodiscard]] std::optional<sim::Pose> model_pose(std::string_view name, sim::Time time) const;
    /// What moves with the robot; no_model where nothing does.
    [[nodiscard]] sim::ModelId body_of(std::string_view robot) const;
    /// Bodies that the scene has no movable model for, by robot.
    [[nodiscard]] std::map<std::string, std::string> lost_bodies() const;

    /// The thing is there; between two poses that follow each other closely it moves evenly.
    /// Returns why not, where it cannot be: no such robot, no such movable model, a time that is
    /// not later than the pose before.
    std::optional<std::string> place_robot(std::string_view name, const Placement& placement);
    /// For senders that name none: fails where there is more than one.
    std::optional<std::string> place_only_robot(const Placement& placement);
    /// It follows its script no more.
    std::optional<std::string> place_model(std::string_view name, const Placement& placement);
    /// A pose leaves nothing open that may be elsewhere at the same time.
    [[nodiscard]] bool has_one_mover() const;
    /// Called after everything that was placed.
    void on_placed(std::function<void()> callback) { on_placed_ = std::move(callback); }

    /// Nothing that streams of poses have to say of the time until then is still to come; of stale
    /// ones nothing is expected.
    [[nodiscard]] bool poses_known(sim::Time until) const;

    /// What casts for a sensor, "robot/sensor".
    [[nodiscard]] const SharedChoice& choice_of(std::string_view sensor) const {
        return backends_.choice_of(sensor);
    }
    /// The same, with its models where they were put last.
    [[nodiscard]] sim::RangeBackend& backend(std::string_view sensor) const {
        return backends_.of(sensor);
    }
    /// Whoever has cast says so.
    void tell_cast(const Cast& cast) const {
        if (on_cast_) on_cast_(cast);
    }
    void on_cast(std::function<void(const Cast&)> callback) { on_cast_ = std::move(callback); }

    /// Where all models are, by ModelId.
    [[nodiscard]] std::vector<sim::Pose> poses_at(sim::Time time) const;
    /// The movable models but one, between these times; good until they are asked for again or
    /// something is replaced.
    [[nodiscard]] std::vector<sim::Mover> movers(sim::Time from, sim::Time to,
                                                 sim::ModelId except = sim::no_model);

  private:
    struct Robot {
        RobotStart start;
        sim::PoseTrack track;
    };

    struct MovableModel {
        sim::ModelId id;
        sim::Pose start;
        double radius_m;       ///< of all its points around its origin
        sim::PoseTrack track;  ///< of its own; a body follows its robot's
        sim::SharedScript script;
        sim::Time begun{};    ///< the script
        bool placed = false;  ///< somebody has moved it
        const Robot* carrier = nullptr;

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

    void find_carriers();
    void end_script(MovableModel& model, const Placement& placement);
    std::optional<std::string> place(sim::PoseTrack& track, const Placement& placement);

    sim::SharedScene scene_;
    sim::SharedScene names_;  ///< scene_ without shapes
    std::map<std::string, Robot, std::less<>> robots_;
    std::map<std::string, MovableModel, std::less<>> movable_;
    SensorBackends backends_;
    std::function<void()> on_placed_;
    std::function<void(const Cast&)> on_cast_;
};

}  // namespace scipd::daemon
