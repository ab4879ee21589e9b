// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The movable models of a world in a row, for sweeps: which of them move, and which of these are
// near. Views the models; whoever owns them keeps them where they are. The thread of its world.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "daemon/world/robot.h"
#include "sim/time.h"
#include "sim/world/mover.h"
#include "sim/world/pose.h"
#include "sim/world/pose_track.h"
#include "sim/world/scene.h"
#include "sim/world/script.h"

namespace scipd::daemon {

/// A model of the world that can move: by poses, by its script, or with the robot whose body it is.
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

struct Ball {
    glm::dvec3 middle_m{0.0};
    double radius_m = 0.0;
};

/// The places of something that moves since some time, roughly: a ball that it has not left. Of ten
/// thousand models a sweep has to tell quickly which ones are far away.
class Whereabouts {
  public:
    /// A place that is not known.
    Whereabouts() = default;
    /// It is there from this time on, with all its points in this ball.
    Whereabouts(const Ball& ball, sim::Time since)
        : at_m_(ball.middle_m), radius_m_(ball.radius_m), last_m_(at_m_), since_(since) {}

    /// It went straight there, or jumped, and goes on by up to `on_m`. It was where it was before
    /// until `left`, or went on from there.
    void goes_to(const glm::dvec3& to_m, sim::Time left, double on_m = 0.0) {
        constexpr double most_strays_m = 2.0;
        const double before_m = std::exchange(on_m_, on_m);
        const double strays_m = std::max(strays_m_, glm::distance(at_m_, to_m) + on_m);
        if (strays_m <= most_strays_m) {
            strays_m_ = strays_m;
        } else if (since_ != unknown) {
            at_m_ = to_m;
            strays_m_ = std::max(glm::distance(last_m_, to_m) + before_m, on_m);
            since_ = left;
        }
        last_m_ = to_m;
    }

    /// True if no part of it is in the ball at any time from this one on.
    [[nodiscard]] bool is_outside(const Ball& ball, sim::Time from) const {
        const double reach_m = ball.radius_m + radius_m_ + strays_m_;
        const glm::dvec3 apart_m = at_m_ - ball.middle_m;
        return from >= since_ && glm::dot(apart_m, apart_m) > reach_m * reach_m;
    }

  private:
    static constexpr sim::Time unknown = sim::Time::max();

    glm::dvec3 at_m_{0.0};
    double radius_m_ = 0.0;
    double strays_m_ = 0.0;
    double on_m_ = 0.0;  ///< from where it went last
    glm::dvec3 last_m_{0.0};
    sim::Time since_ = unknown;
};

class Movers {
  public:
    using Models = std::map<std::string, MovableModel, std::less<>>;

    /// These are the models from now on.
    void view(Models& models);
    /// A pose has come for the model, which was where it was before until `left`.
    void goes_to(const MovableModel& model, const sim::Pose& pose, sim::Time left) {
        whereabouts_[model.place].goes_to(pose.translation_m, left, goes_on_m(model));
    }
    /// It moves by poses now, and by its script before.
    void leaves_script(const MovableModel& model);

    /// Nothing can move.
    [[nodiscard]] bool empty() const { return models_.empty(); }
    /// How all but `except` move between these times. Good until the next call.
    [[nodiscard]] std::vector<sim::Mover> all(sim::Time from, sim::Time to,
                                              sim::ModelId except) const;
    /// How those move of which something is in the ball then. Good until the next call.
    [[nodiscard]] std::vector<sim::Mover> within(const Ball& ball, sim::Time from, sim::Time to,
                                                 sim::ModelId except) const;

  private:
    /// Distance that it goes after its last pose, m.
    [[nodiscard]] static double goes_on_m(const MovableModel& model);

    std::vector<MovableModel*> models_;
    std::vector<Whereabouts> whereabouts_;  ///< side by side, since each sweep looks at all
};

}  // namespace scipd::daemon
