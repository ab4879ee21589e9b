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
#include <vector>

#include <glm/geometric.hpp>

namespace scipd::sim {
namespace {

/// The path length of a model: how far its points have gone at most, from the first leg on. Time is
/// counted in beams of a sweep and fractions of them.
class PathLength {
  public:
    /// One more leg, after those that were added before.
    void add(double from_beam, double to_beam, double length_m) {
        const double gone_m = marks_.empty() ? 0.0 : marks_.back().gone_m;
        marks_.push_back({from_beam, gone_m});
        marks_.push_back({to_beam, gone_m + length_m});
    }
    [[nodiscard]] double gone_m(double beam) const;
    /// The last moment at which it has gone no farther than this.
    [[nodiscard]] double beam_at(double gone_m) const;

  private:
    struct Mark {
        double beam = 0.0;
        double gone_m = 0.0;
    };
    std::vector<Mark> marks_;  ///< both grow or stay; between two marks the model moves evenly
};

double PathLength::gone_m(double beam) const {
    const auto after = std::ranges::upper_bound(marks_, beam, {}, &Mark::beam);
    if (after == marks_.begin()) return 0.0;
    const Mark& before = *std::prev(after);
    if (after == marks_.end()) return before.gone_m;
    const double share = (beam - before.beam) / (after->beam - before.beam);
    return std::lerp(before.gone_m, after->gone_m, share);
}

double PathLength::beam_at(double gone_m) const {
    const auto after = std::ranges::upper_bound(marks_, gone_m, {}, &Mark::gone_m);
    if (after == marks_.end()) return std::numeric_limits<double>::infinity();
    const Mark& before = *std::prev(after);  // exists: the first mark is 0 m
    const double share = (gone_m - before.gone_m) / (after->gone_m - before.gone_m);
    return std::lerp(before.beam, after->beam, share);
}

/// Backends round by less than this.
constexpr double margin_m = 5e-3;

/// A mover by the beams that may meet it.
struct Encounter {
    std::size_t first = 0;
    std::size_t end = 0;     ///< behind the last; first == end: none
    double nearest_m = 0.0;  ///< it is nowhere nearer to the sensor
    PathLength path = {};    ///< while these are fired

    /// One placement holds from `beam` to before the returned beam: meanwhile the model moves no
    /// farther than moves_within_part_m.
    [[nodiscard]] std::size_t good_until(std::size_t beam) const {
        const auto from = static_cast<double>(beam);
        const double last = path.beam_at(path.gone_m(from) + moves_within_part_m);
        return last < static_cast<double>(end) ? static_cast<std::size_t>(std::max(last, from)) + 1
                                               : end;
    }
};

class Sweeping {
  public:
    Sweeping(const SensorSpec& optics, const SensorMotion& sensor,
             const std::function<Time(std::size_t)>& fired)
        : optics_(optics),
          beams_(static_cast<std::size_t>(optics.beams())),
          fired_(fired),
          sensor_(sensor),
          sensor_from_world_(inverse(sensor_.middle)),
          begin_(fired(0)),
          middle_(fired(beams_ / 2)),
          end_(fired(beams_ - 1)),
          reach_rad_(optics.footprint.reach_rad()) {}

    /// In front of what the scan has met; null: nobody knows.
    [[nodiscard]] Encounter encounter(const Mover& mover, const Scan* met) const;
    [[nodiscard]] std::vector<Passing> passings(std::span<const Mover> movers,
                                                const Scan& met) const;
    [[nodiscard]] std::vector<Part> parts(std::span<const Mover> movers,
                                          std::span<const Encounter> met) const;

  private:
    /// The beams that may meet a ball around the model's origin. The ball is large enough to hold
    /// the model during the whole sweep, as the moving sensor sees it.
    [[nodiscard]] Encounter met_within(const Pose& middle, double strays_m, double radius_m) const;
    [[nodiscard]] Encounter between(double low_rad, double high_rad) const;
    /// Leaves out beams that end before it, from both ends.
    static void leave_out_hidden(const Scan& scan, Encounter& met);
    [[nodiscard]] double beam_at(Time time) const;
    [[nodiscard]] Time time_at(double beam) const;
    [[nodiscard]] std::size_t first_fired_at(Time time) const;
    /// The latest beam with which the next part may begin.
    [[nodiscard]] std::size_t reach(std::span<const Encounter> met, std::size_t from) const;
    /// When the mover is placed for the beams from there on: halfway along its path meanwhile.
    [[nodiscard]] Time time_of(const Encounter& met, std::size_t from) const;

    const SensorSpec& optics_;
    std::size_t beams_;
    const std::function<Time(std::size_t)>& fired_;
    SensorMotion sensor_;
    Pose sensor_from_world_;
    Time begin_;
    Time middle_;
    Time end_;
    double reach_rad_;  ///< of a footprint beside its beam
};

Encounter Sweeping::encounter(const Mover& mover, const Scan* scan) const {
    const std::vector<PoseTrack::Leg> legs = mover.path->legs(begin_, end_);
    const Pose middle = mover.path->at(middle_);
    double strays_m = 0.0;
    for (const PoseTrack::Leg& leg : legs) {
        strays_m = std::max({strays_m, glm::distance(leg.from_m, middle.translation_m),
                             glm::distance(leg.to_m, middle.translation_m)});
    }
    Encounter met = met_within(middle, strays_m, mover.radius_m);
    if (scan != nullptr) leave_out_hidden(*scan, met);
    if (met.first == met.end) return met;
    const Time first = fired_(met.first);
    const Time last = fired_(met.end - 1);
    for (const PoseTrack::Leg& leg : legs) {
        if (leg.end <= first || leg.begin >= last) continue;
        met.path.add(beam_at(leg.begin), beam_at(leg.end), path_length_m(leg, mover.radius_m));
    }
    return met;
}

void Sweeping::leave_out_hidden(const Scan& scan, Encounter& met) {
    const auto sees = [&](std::size_t beam) {
        const auto rays =
            std::span(scan.hits).subspan(beam * scan.rays_per_beam, scan.rays_per_beam);
        return std::ranges::any_of(
            rays, [&](const Hit& hit) { return double{hit.range_m} >= met.nearest_m; });
    };
    while (met.first < met.end && !sees(met.first))
        ++met.first;
    while (met.first < met.end && !sees(met.end - 1))
        --met.end;
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
    const double halfway_m = std::midpoint(met.path.gone_m(low), met.path.gone_m(high));
    return time_at(std::clamp(met.path.beam_at(halfway_m), low, high));
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
    const Encounter all{0, beams_};
    const Encounter none{};
    const glm::dvec3 centre_m = sensor_from_world_ * middle.translation_m;
    const double distance_m = glm::length(centre_m);
    const double ball_m = radius_m + strays_m + sensor_.moved_m +
                          (sensor_.turned_rad + reach_rad_) * distance_m + margin_m;
    if (distance_m <= ball_m) return all;
    if (distance_m - ball_m > optics_.max_range_m) return none;
    // The beams lie in the plane z = 0, which cuts a circle out of the ball.
    if (std::abs(centre_m.z) > ball_m) return none;
    const double circle_m = std::sqrt(ball_m * ball_m - centre_m.z * centre_m.z);
    const double ahead_m = std::hypot(centre_m.x, centre_m.y);
    if (ahead_m <= circle_m) return all;
    const double bearing_rad = std::atan2(centre_m.y, centre_m.x);
    const double half_rad = std::asin(circle_m / ahead_m);
    Encounter met = between(bearing_rad - half_rad, bearing_rad + half_rad);
    met.nearest_m = distance_m - ball_m;
    return met;
}

/// The shortest run of beams that holds all beams between these bearings. A bearing may be counted
/// in the turn before or after this one.
Encounter Sweeping::between(double low_rad, double high_rad) const {
    const double beams_per_rad = optics_.steps_per_turn / (2.0 * std::numbers::pi);
    const double front = optics_.front_step - optics_.first_step;
    Encounter met{beams_, 0};
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
            // The first part places all, so that no beam meets one where it was in the last sweep.
            if (during || from == 0) part.updates.push_back({i, time_of(met[i], from)});
        }
        from = end;
    }
    return parts;
}

std::vector<Passing> Sweeping::passings(std::span<const Mover> movers, const Scan& scan) const {
    std::vector<Passing> passings;
    for (std::size_t i = 0; i < movers.size(); ++i) {
        const Encounter met = encounter(movers[i], &scan);
        for (std::size_t from = met.first; from < met.end;) {
            const std::size_t end = met.good_until(from);
            passings.push_back({i, {from, end - from}, time_of(met, from)});
            from = end;
        }
    }
    return passings;
}

}  // namespace

std::vector<Passing> passings_of_sweep(const SensorSpec& optics, const SensorMotion& sensor,
                                       const Scan& scan,
                                       const std::function<Time(std::size_t beam)>& fired,
                                       std::span<const Mover> movers) {
    return Sweeping(optics, sensor, fired).passings(movers, scan);
}

std::vector<Part> parts_of_sweep(const SensorSpec& optics, std::span<const Pose> world_from_sensor,
                                 const std::function<Time(std::size_t beam)>& fired,
                                 std::span<const Mover> movers) {
    if (movers.empty()) return {{.beams = {0, static_cast<std::size_t>(optics.beams())}}};
    const Sweeping sweep(optics, motion_of(world_from_sensor), fired);
    std::vector<Encounter> met;
    met.reserve(movers.size());
    for (const Mover& mover : movers)
        met.push_back(sweep.encounter(mover, nullptr));
    return sweep.parts(movers, met);
}

}  // namespace scipd::sim
