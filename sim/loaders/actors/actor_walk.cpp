// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/actors/actor_walk.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <glm/geometric.hpp>

namespace scipd::sim {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr double stray_m = 1e-4;
constexpr Time shortest_step = std::chrono::milliseconds(1);
/// A change of pose within this time is a jump.
constexpr Time instant{1};
/// Sums of times up to this one still fit into a Time.
constexpr Seconds longest{4e9};
/// For one trajectory: 7 MB.
constexpr std::size_t most_walk_steps = 100'000;

/// The curve from one waypoint, at s = 0, to the next, at s = 1.
struct Cubic {
    glm::dvec3 from_m;
    glm::dvec3 to_m;
    glm::dvec3 leaves_m;  ///< derivative by s
    glm::dvec3 arrives_m;

    [[nodiscard]] glm::dvec3 at(double s) const {
        const double rest = 1.0 - s;
        return rest * rest * ((1.0 + 2.0 * s) * from_m + s * leaves_m) +
               s * s * ((1.0 + 2.0 * rest) * to_m - rest * arrives_m);
    }

    /// A chord strays from the curve by at most an eighth of the second derivative, which is
    /// greatest at an end.
    [[nodiscard]] std::size_t parts() const {
        const glm::dvec3 way_m = to_m - from_m;
        const double bend_m = std::max(glm::length(6.0 * way_m - 4.0 * leaves_m - 2.0 * arrives_m),
                                       glm::length(6.0 * way_m - 2.0 * leaves_m - 4.0 * arrives_m));
        return static_cast<std::size_t>(std::ceil(std::sqrt(bend_m / 8.0 / stray_m)));
    }
};

class Spline {
  public:
    explicit Spline(const ActorTrajectory& trajectory) : points_(trajectory.waypoints) {
        // If the first waypoint has a later time, the actor waits at it.
        if (const Waypoint first = points_.front(); first.time > Time{})
            points_.insert(points_.begin(), Waypoint{Time{}, first.pose});
        pull_ = 0.5 * (1.0 - trajectory.tension);
    }

    [[nodiscard]] Time duration() const { return points_.back().time; }

    void append_to(std::vector<Script::Step>& steps, Time begin) const {
        const std::size_t most = std::max(most_walk_steps / points_.size(), std::size_t{1});
        for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
            const Time span = points_[i + 1].time - points_[i].time;
            const Cubic cubic = from(i);
            const std::size_t parts =
                std::clamp(cubic.parts(), std::size_t{1},
                           std::min(most, static_cast<std::size_t>(span / shortest_step)));
            for (std::size_t part = 0; part < parts; ++part) {
                const double s = static_cast<double>(part) / static_cast<double>(parts);
                const Time since = std::chrono::duration_cast<Time>(s * Seconds(span));
                steps.push_back({begin + points_[i].time + since, {cubic.at(s), turned(i, s)}});
            }
        }
        steps.push_back({begin + duration(), points_.back().pose});
    }

  private:
    [[nodiscard]] const glm::dvec3& at_m(std::size_t i) const {
        return points_[i].pose.translation_m;
    }

    /// A path that ends where it begins is a closed loop, and smooth there.
    [[nodiscard]] glm::dvec3 tangent_m(std::size_t i) const {
        const std::size_t last = points_.size() - 1;
        const bool closed = at_m(0) == at_m(last);
        const bool is_end = i == 0 || i == last;
        if (is_end && closed) return pull_ * (at_m(1) - at_m(last - 1));
        return pull_ * (at_m(std::min(i + 1, last)) - at_m(i == 0 ? 0 : i - 1));
    }

    [[nodiscard]] Cubic from(std::size_t i) const {
        return {at_m(i), at_m(i + 1), tangent_m(i), tangent_m(i + 1)};
    }

    [[nodiscard]] glm::dquat turned(std::size_t i, double s) const {
        return interpolate(points_[i].pose, points_[i + 1].pose, s).rotation;
    }

    std::vector<Waypoint> points_;
    double pull_;
};

/// Ends the steps just before `time`, at which the actor jumps elsewhere.
void end_before(Time time, std::vector<Script::Step>& steps) {
    if (steps.empty() || steps.back().time < time) return;
    const Time latest = time - instant;
    const Time before = steps.size() > 1 ? steps[steps.size() - 2].time : -instant;
    if (before < latest) {
        steps.back().time = latest;
    } else {
        steps.pop_back();
    }
}

}  // namespace

SharedScript walk_of(const std::vector<ActorTrajectory>& trajectories, Time delay, bool loops) {
    const Pose& start = trajectories.front().waypoints.front().pose;
    auto walk = std::make_shared<Script>();
    if (delay > Time{}) walk->steps.push_back({{}, start});
    Time end = delay;
    for (const ActorTrajectory& trajectory : trajectories) {
        const Spline spline(trajectory);
        if (Seconds(end) + Seconds(spline.duration()) > longest) return nullptr;
        end_before(end, walk->steps);
        spline.append_to(walk->steps, end);
        end += spline.duration();
    }
    const bool goes_round = loops && end - delay >= shortest_step;
    if (!goes_round) return walk;
    end_before(end, walk->steps);
    walk->lap = end;
    return walk;
}

}  // namespace scipd::sim
