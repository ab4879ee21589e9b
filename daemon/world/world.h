// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The world as it is now: the scene, where its robots and movable models are, and the backends that
// cast into it. A scene is never changed: another one is swapped in whole. Where sensors live on
// several threads, each has a copy of the world that the I/O thread changes. One thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "daemon/world/cast.h"
#include "daemon/world/light.h"
#include "daemon/world/movers.h"
#include "daemon/world/robot.h"
#include "daemon/world/sensor_backends.h"
#include "sim/backends/range_backend.h"
#include "sim/expected.h"
#include "sim/time.h"
#include "sim/world/pose.h"
#include "sim/world/pose_track.h"
#include "sim/world/scene.h"
#include "sim/world/script.h"

namespace scipd::daemon {

/// A sender says that a robot or a model is at this pose.
struct Placement {
    sim::Time time{};
    sim::Pose pose;
    std::optional<sim::Velocity> velocity;
    /// The sender gave no time. The pose holds from now on and replaces poses of later times.
    bool from_now_on = false;
};

/// The reason for which a placement is refused.
struct NotPlaced : sim::Fault {
    enum class Reason {
        unknown,    ///< there is no such thing, or several could be meant
        carried,    ///< it is the body of a robot, and goes where the robot goes
        not_later,  ///< its time is not later than that of the pose before it
    };
    Reason reason = Reason::unknown;
};

using Placed = tl::expected<void, NotPlaced>;

class World {
  public:
    World() = default;
    /// A copy, for the sensors of this shard: it is as the original is, as long as it is told of
    /// every change.
    explicit World(std::size_t shard) : shard_(shard) {}

    /// What has been done to a world, to be done to its copies.
    using Change = std::function<void(World& copy)>;
    enum class Haste {
        soon,
        now,  ///< the original must not go on before
    };
    /// `callback` is called after each change. From then on this is an original, in which nothing
    /// is cast.
    void on_change(std::function<void(const Change&, Haste)> callback) {
        on_change_ = std::move(callback);
    }

    /// Puts another scene in place of this one, with the backends made for it. Robots stay where
    /// they are. A movable model stays, and goes on with its script, if the old scene had it with
    /// the same start and script and it is not in `placed_anew`; any other starts where the new
    /// scene has it and begins its script now. Returns the old backends, bound to no thread.
    SensorBackends replace_scene(sim::SharedScene scene, SensorBackends backends,
                                 const std::set<std::string>& placed_anew = {}, sim::Time now = {});
    /// Puts other backends for the same scene in place of these, which it returns.
    SensorBackends replace_backends(SensorBackends backends);
    [[nodiscard]] const sim::SharedScene& scene() const { return scene_; }
    /// Grows whenever there are other objects, materials or robots.
    [[nodiscard]] std::uint64_t edition() const { return edition_; }
    /// The scene without its shapes, which take much memory: for those who keep records of scans.
    [[nodiscard]] const sim::SharedScene& names() const { return names_; }

    [[nodiscard]] Light& light() { return light_; }
    [[nodiscard]] const Light& light() const { return light_; }
    /// As those of Light, for copies as well.
    void set_materials(const sim::SharedMaterials& materials);
    void set_media(const std::vector<sim::Medium>& media);
    void configure_media(const std::vector<sim::Medium>& media);

    using Robots = std::map<std::string, Robot, std::less<>>;
    /// The robots are these from now on. One that was there before stays where it is, unless its
    /// configuration has changed.
    void set_robots(const std::map<std::string, RobotStart>& robots);
    /// Null where there is no robot of that name.
    [[nodiscard]] const sim::PoseTrack* robot(std::string_view name) const;
    [[nodiscard]] const Robots& robots() const { return robots_; }
    /// Null where there is no movable model of that name. A body has the track of its robot. For a
    /// model that follows its script, ask model_pose().
    [[nodiscard]] const sim::PoseTrack* model(std::string_view name) const;
    /// Where the model is, whatever moves it: poses, its script or its robot.
    [[nodiscard]] std::optional<sim::Pose> model_pose(std::string_view name, sim::Time time) const;
    /// The model that moves with the robot; no_model where none does.
    [[nodiscard]] sim::ModelId body_of(std::string_view robot) const;
    /// The bodies, by robot, that the scene has no movable model for.
    [[nodiscard]] std::map<std::string, std::string> lost_bodies() const;

    /// Puts the robot there. Between two poses that follow each other closely it moves evenly.
    [[nodiscard]] Placed place_robot(std::string_view name, const Placement& placement);
    /// Puts the only robot there, for senders that name none; refused unless there is exactly one.
    [[nodiscard]] Placed place_only_robot(const Placement& placement);
    /// Puts a movable model there, which no longer follows its script then.
    [[nodiscard]] Placed place_model(std::string_view name, const Placement& placement);
    /// Whether one robot is all that can move, so that one pose tells all about its time.
    [[nodiscard]] bool has_one_mover() const;
    /// `callback` is called after every pose that is taken.
    void on_placed(std::function<void()> callback) { on_placed_ = std::move(callback); }

    /// Whether all poses of times up to `until` have come. Nobody waits for a stale stream.
    [[nodiscard]] bool poses_known(sim::Time until) const;

    /// What casts for a sensor, "robot/sensor", and why.
    [[nodiscard]] const SharedChoice& choice_of(std::string_view sensor) const {
        return backends_.choice_of(sensor);
    }
    /// What casts for it, with the models where they were put last. Not const: a backend moves
    /// models.
    [[nodiscard]] sim::RangeBackend& backend(std::string_view sensor) {
        return backends_.of(sensor);
    }
    /// To be called after a cast; passes it to the callback of on_cast().
    void tell_cast(const Cast& cast) const {
        if (on_cast_) on_cast_(cast);
    }
    void on_cast(std::function<void(const Cast&)> callback) { on_cast_ = std::move(callback); }

    [[nodiscard]] std::vector<sim::Pose> poses_at(sim::Time time) const;  ///< by ModelId
    /// The paths of all movable models. Not const: sweeps ask how scripts move them. Good until the
    /// scene or the robots are replaced.
    [[nodiscard]] const Movers& movers() { return movers_; }

  private:
    void tell(const Change& change, Haste haste) const {
        if (on_change_) on_change_(change, haste);
    }
    [[nodiscard]] SensorBackends exchange_backends(SensorBackends backends);
    void find_carriers();
    void end_script(MovableModel& model, const Placement& placement);
    Placed place(sim::PoseTrack& track, const Placement& placement);

    std::optional<std::size_t> shard_;
    std::function<void(const Change&, Haste)> on_change_;
    sim::SharedScene scene_;
    sim::SharedScene names_;  ///< scene_ without shapes
    std::uint64_t edition_ = 0;
    Robots robots_;
    Movers::Models movable_;
    Movers movers_;  ///< of movable_
    SensorBackends backends_;
    Light light_;
    std::function<void()> on_placed_;
    std::function<void(const Cast&)> on_cast_;
};

}  // namespace scipd::daemon
