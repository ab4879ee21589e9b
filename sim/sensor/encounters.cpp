// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/encounters.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>

namespace scipd::sim {
namespace {

/// What a model may move between the moment that it is put at and a beam that meets it, twice.
constexpr double within_m = 1e-3;

/// For ways that are not quite what a few moments of them show.
constexpr double margin_m = 5e-3;

/// How far the sensor strays from its pose in the middle of the sweep.
struct Sway {
    Pose middle;
    double moved_m = 0.0;
    double turned_rad = 0.0;
};

struct Waypoint {
    Time time{};
    Pose pose;
};

/// A mover by the beams that may meet it.
struct Encounter {
    std::size_t first = 0;
    std::size_t end = 0;      ///< behind the last; first == end: none
    std::size_t stretch = 0;  ///< within so many beams it moves no more than it may
    std::size_t jump = 0;     ///< the first beam after it is somewhere else at once

    /// What is put for this beam holds until then.
    [[nodiscard]] std::size_t good_until(std::size_t beam) const {
        return beam < jump ? std::min(beam + stretch, jump) : beam + stretch;
    }
};

double angle_between(const glm::dquat& a, const glm::dquat& b) {
    return 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(a, b))));
}

Sway sway_of(std::span<const Pose> poses) {
    constexpr std::size_t samples = 8;
    Sway sway{poses[poses.size() / 2]};
    for (std::size_t i = 0; i <= samples; ++i) {
        const Pose& pose = poses[i * (poses.size() - 1) / samples];
        sway.moved_m =
            std::max(sway.moved_m, glm::distance(pose.translation_m, sway.middle.translation_m));
        sway.turned_rad =
            std::max(sway.turned_rad, angle_between(pose.rotation, sway.middle.rotation));
    }
    return sway;
}

/// The farthest that a point of the model moves.
double movement_m(const Pose& from, const Pose& to, double radius_m) {
    return glm::distance(from.translation_m, to.translation_m) +
           angle_between(from.rotation, to.rotation) * radius_m;
}

class Sweeping {
  public:
    Sweeping(const SensorSpec& optics, std::span<const Pose> poses,
             const std::function<Time(std::size_t)>& fired)
        : optics_(optics),
          beams_(static_cast<std::size_t>(optics.beams())),
          fired_(fired),
          sway_(sway_of(poses)),
          sensor_from_world_(inverse(sway_.middle)),
          begin_(fired(0)),
          middle_(fired(beams_ / 2)),
          end_(fired(beams_ - 1)) {}

    [[nodiscard]] Encounter encounter(const Mover& mover) const;
    [[nodiscard]] std::vector<Part> parts(std::span<const Mover> movers,
                                          std::span<const Encounter> met) const;

  private:
    /// Beams that may meet a ball around the model's origin which holds it all the time, as the
    /// turning sensor sees it.
    [[nodiscard]] Encounter met_within(const Pose& middle, double strays_m, double radius_m) const;
    [[nodiscard]] Encounter between(double low_rad, double high_rad) const;
    /// What a point of it moves in the time of a beam, on its way between these two.
    [[nodiscard]] double step_m(const Waypoint& from, const Waypoint& to, const Mover& mover) const;
    [[nodiscard]] std::size_t first_fired_at(Time time) const;
    /// The next part begins here at the latest.
    [[nodiscard]] std::size_t reach(std::span<const Encounter> met, std::size_t from) const;
    /// At which it is put for the beams from there on.
    [[nodiscard]] Time time_of(const Encounter& met, std::size_t from) const {
        const std::size_t first = std::max(met.first, from);
        const std::size_t last = std::min(met.end, met.good_until(first));
        return first < last ? fired_((first + last) / 2) : middle_;
    }

    const SensorSpec& optics_;
    std::size_t beams_;
    const std::function<Time(std::size_t)>& fired_;
    Sway sway_;
    Pose sensor_from_world_;
    Time begin_;
    Time middle_;
    Time end_;
};

Encounter Sweeping::encounter(const Mover& mover) const {
    const PoseTrack& path = *mover.path;
    const Pose middle = path.at(middle_);
    if (path.still(begin_, end_)) return met_within(middle, 0.0, mover.radius_m);
    const Pose before = path.at(begin_);
    const Pose after = path.at(end_);
    const double strays_m = glm::distance(before.translation_m, middle.translation_m) +
                            glm::distance(middle.translation_m, after.translation_m);
    Encounter met = met_within(middle, strays_m, mover.radius_m);
    if (met.first == met.end) return met;
    double most_m = 0.0;  // in the time of a beam
    if (const std::optional<Time> jump = path.first_jump(begin_, end_)) {
        met.jump = first_fired_at(*jump);
        const Time just_before = *jump - Time{1};
        most_m = std::max(step_m({begin_, before}, {just_before, path.at(just_before)}, mover),
                          step_m({*jump, path.at(*jump)}, {end_, after}, mover));
    } else {
        most_m = std::max(step_m({begin_, before}, {middle_, middle}, mover),
                          step_m({middle_, middle}, {end_, after}, mover));
    }
    met.stretch =
        static_cast<std::size_t>(std::clamp(within_m / most_m, 1.0, static_cast<double>(beams_)));
    return met;
}

double Sweeping::step_m(const Waypoint& from, const Waypoint& to, const Mover& mover) const {
    const double beams = static_cast<double>(beams_) *
                         std::chrono::duration<double>(to.time - from.time) /
                         std::chrono::duration<double>(end_ - begin_);
    return beams > 0.0 ? movement_m(from.pose, to.pose, mover.radius_m) / beams : 0.0;
}

std::size_t Sweeping::first_fired_at(Time time) const {
    std::size_t first = 0;
    for (std::size_t end = beams_; first < end;) {
        const std::size_t middle = (first + end) / 2;
        if (fired_(middle) < time)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

Encounter Sweeping::met_within(const Pose& middle, double strays_m, double radius_m) const {
    const Encounter all{0, beams_, beams_};
    const Encounter none{0, 0, beams_};
    const glm::dvec3 centre_m = sensor_from_world_ * middle.translation_m;
    const double distance_m = glm::length(centre_m);
    const double ball_m =
        radius_m + strays_m + sway_.moved_m + sway_.turned_rad * distance_m + margin_m;
    if (distance_m <= ball_m) return all;
    if (distance_m - ball_m > optics_.max_range_m) return none;
    // The beams lie in the plane z = 0, which cuts a circle out of the ball.
    if (std::abs(centre_m.z) > ball_m) return none;
    const double circle_m = std::sqrt(ball_m * ball_m - centre_m.z * centre_m.z);
    const double ahead_m = std::hypot(centre_m.x, centre_m.y);
    if (ahead_m <= circle_m) return all;
    const double bearing_rad = std::atan2(centre_m.y, centre_m.x);
    const double half_rad = std::asin(circle_m / ahead_m);
    return between(bearing_rad - half_rad, bearing_rad + half_rad);
}

/// The least stretch of beams that holds all with such a bearing, in whatever turn it is counted.
Encounter Sweeping::between(double low_rad, double high_rad) const {
    const double beams_per_rad = optics_.steps_per_turn / (2.0 * std::numbers::pi);
    const double front = optics_.front_step - optics_.first_step;
    Encounter met{beams_, 0, beams_};
    for (const int turn : {-1, 0, 1}) {
        const double shift = front + turn * optics_.steps_per_turn;
        const double first = std::floor(low_rad * beams_per_rad + shift);
        const double last = std::ceil(high_rad * beams_per_rad + shift);
        if (last < 0.0 || first > static_cast<double>(beams_ - 1)) continue;
        met.first = std::min(met.first, static_cast<std::size_t>(std::max(first, 0.0)));
        met.end = std::max(met.end, std::min(beams_, static_cast<std::size_t>(last) + 1));
    }
    return met.first < met.end ? met : Encounter{0, 0, beams_};
}

std::size_t Sweeping::reach(std::span<const Encounter> met, std::size_t from) const {
    std::size_t end = beams_;
    for (const Encounter& one : met) {
        if (one.end <= from) continue;
        const std::size_t until = one.good_until(std::max(one.first, from));
        if (until < one.end) end = std::min(end, until);
    }
    return end;
}

std::vector<Part> Sweeping::parts(std::span<const Mover> movers,
                                  std::span<const Encounter> met) const {
    std::vector<Part> parts;
    for (std::size_t from = 0; from < beams_;) {
        const std::size_t end = reach(met, from);
        Part& part = parts.emplace_back(Part{{from, end - from}, {}, {}});
        for (std::size_t i = 0; i < met.size(); ++i) {
            const bool during = met[i].first < end && met[i].end > from;
            if (during) part.can_meet.push_back(movers[i].id);
            // Before the first part all are put, so that none is met where it has been earlier.
            if (during || from == 0) part.puts.push_back({i, time_of(met[i], from)});
        }
        from = end;
    }
    return parts;
}

}  // namespace

std::vector<Part> parts_of_sweep(const SensorSpec& optics, std::span<const Pose> world_from_sensor,
                                 const std::function<Time(std::size_t beam)>& fired,
                                 std::span<const Mover> movers) {
    const Sweeping sweep(optics, world_from_sensor, fired);
    std::vector<Encounter> met;
    met.reserve(movers.size());
    for (const Mover& mover : movers)
        met.push_back(sweep.encounter(mover));
    return sweep.parts(movers, met);
}

}  // namespace scipd::sim
