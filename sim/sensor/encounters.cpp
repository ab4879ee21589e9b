// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/encounters.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>

#include <glm/geometric.hpp>

namespace scipd::sim {
namespace {

/// For what backends round.
constexpr double margin_m = 5e-3;

/// How far the sensor strays from its pose in the middle of the sweep.
struct Sway {
    Pose middle;
    double moved_m = 0.0;
    double turned_rad = 0.0;
};

/// What the points of a model have gone by when, at most. Times are told in beams and parts of
/// them.
class Way {
  public:
    /// After all that it has gone.
    void go(double from_beam, double to_beam, double way_m) {
        const double gone_m = marks_.empty() ? 0.0 : marks_.back().gone_m;
        marks_.push_back({from_beam, gone_m});
        marks_.push_back({to_beam, gone_m + way_m});
    }
    [[nodiscard]] double gone_m(double beam) const;
    /// The last moment that it has gone no farther.
    [[nodiscard]] double beam_at(double gone_m) const;

  private:
    struct Mark {
        double beam = 0.0;
        double gone_m = 0.0;
    };
    std::vector<Mark> marks_;  ///< neither ever sinks; between two it moves evenly
};

double Way::gone_m(double beam) const {
    const auto after = std::ranges::upper_bound(marks_, beam, {}, &Mark::beam);
    if (after == marks_.begin()) return 0.0;
    const Mark& before = *std::prev(after);
    if (after == marks_.end()) return before.gone_m;
    const double share = (beam - before.beam) / (after->beam - before.beam);
    return std::lerp(before.gone_m, after->gone_m, share);
}

double Way::beam_at(double gone_m) const {
    const auto after = std::ranges::upper_bound(marks_, gone_m, {}, &Mark::gone_m);
    if (after == marks_.end()) return std::numeric_limits<double>::infinity();
    const Mark& before = *std::prev(after);  // the first has gone nowhere
    const double share = (gone_m - before.gone_m) / (after->gone_m - before.gone_m);
    return std::lerp(before.beam, after->beam, share);
}

/// A mover by the beams that may meet it.
struct Encounter {
    std::size_t first = 0;
    std::size_t end = 0;  ///< behind the last; first == end: none
    Way way;              ///< while these are fired

    /// From this beam to before that one it moves no more than it may: what is put holds.
    [[nodiscard]] std::size_t good_until(std::size_t beam) const {
        const auto from = static_cast<double>(beam);
        const double last = way.beam_at(way.gone_m(from) + moves_within_part_m);
        return last < static_cast<double>(end) ? static_cast<std::size_t>(std::max(last, from)) + 1
                                               : end;
    }
};

Sway sway_of(std::span<const Pose> poses) {
    Sway sway{poses[poses.size() / 2]};
    double farthest_m2 = 0.0;
    const Pose* most_turned = &sway.middle;
    double least_cosine = 1.0;
    for (const Pose& pose : poses) {
        const glm::dvec3 moved_m = pose.translation_m - sway.middle.translation_m;
        farthest_m2 = std::max(farthest_m2, glm::dot(moved_m, moved_m));
        const double cosine = std::abs(glm::dot(pose.rotation, sway.middle.rotation));
        if (cosine >= least_cosine) continue;
        least_cosine = cosine;
        most_turned = &pose;
    }
    sway.moved_m = std::sqrt(farthest_m2);
    sway.turned_rad = angle_between_rad(most_turned->rotation, sway.middle.rotation);
    return sway;
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
    [[nodiscard]] double beam_at(Time time) const;
    [[nodiscard]] Time time_at(double beam) const;
    [[nodiscard]] std::size_t first_fired_at(Time time) const;
    /// The next part begins here at the latest.
    [[nodiscard]] std::size_t reach(std::span<const Encounter> met, std::size_t from) const;
    /// At which it is put for the beams from there on: halfway through what it moves meanwhile.
    [[nodiscard]] Time time_of(const Encounter& met, std::size_t from) const;

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
    const std::vector<PoseTrack::Leg> legs = mover.path->legs(begin_, end_);
    const Pose middle = mover.path->at(middle_);
    double strays_m = 0.0;
    for (const PoseTrack::Leg& leg : legs) {
        strays_m = std::max({strays_m, glm::distance(leg.from_m, middle.translation_m),
                             glm::distance(leg.to_m, middle.translation_m)});
    }
    Encounter met = met_within(middle, strays_m, mover.radius_m);
    if (met.first == met.end) return met;
    const Time first = fired_(met.first);
    const Time last = fired_(met.end - 1);
    for (const PoseTrack::Leg& leg : legs) {
        if (leg.end <= first || leg.begin >= last) continue;
        met.way.go(beam_at(leg.begin), beam_at(leg.end), way_m(leg, mover.radius_m));
    }
    return met;
}

double Sweeping::beam_at(Time time) const {
    const std::size_t next = first_fired_at(time);
    if (next == 0 || next == beams_) return static_cast<double>(next);
    const Time before = fired_(next - 1);
    const std::chrono::duration<double> since = time - before;
    return static_cast<double>(next - 1) + since / (fired_(next) - before);
}

Time Sweeping::time_at(double beam) const {
    const auto before = static_cast<std::size_t>(beam);
    const Time time = fired_(before);
    if (before + 1 >= beams_) return time;
    const double share = beam - static_cast<double>(before);
    return time + std::chrono::duration_cast<Time>(
                      share * std::chrono::duration<double>(fired_(before + 1) - time));
}

Time Sweeping::time_of(const Encounter& met, std::size_t from) const {
    const std::size_t first = std::max(met.first, from);
    if (first >= met.end) return middle_;
    const std::size_t last = met.good_until(first) - 1;
    const auto low = static_cast<double>(first);
    const auto high = static_cast<double>(last);
    const double halfway_m = std::midpoint(met.way.gone_m(low), met.way.gone_m(high));
    return time_at(std::clamp(met.way.beam_at(halfway_m), low, high));
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
    const Encounter all{0, beams_, {}};
    const Encounter none{0, 0, {}};
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
    Encounter met{beams_, 0, {}};
    for (const int turn : {-1, 0, 1}) {
        const double shift = front + turn * optics_.steps_per_turn;
        const double first = std::floor(low_rad * beams_per_rad + shift);
        const double last = std::ceil(high_rad * beams_per_rad + shift);
        if (last < 0.0 || first > static_cast<double>(beams_ - 1)) continue;
        met.first = std::min(met.first, static_cast<std::size_t>(std::max(first, 0.0)));
        met.end = std::max(met.end, std::min(beams_, static_cast<std::size_t>(last) + 1));
    }
    return met.first < met.end ? met : Encounter{};
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
