// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/encounters.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

using namespace std::chrono_literals;

constexpr Time period = 25ms;

/// A UST-10LX that sees 10 m.
SensorSpec spec() {
    return {.steps_per_turn = 1440,
            .first_step = 0,
            .last_step = 1080,
            .front_step = 540,
            .scan_period = period,
            .max_range_m = 10.0};
}

/// A sweep that begins at 10 s.
Time fired(std::size_t beam) {
    return 10s + period * static_cast<int>(beam) / 1440;
}

double seconds(Time time) {
    return std::chrono::duration<double>(time - 10s).count();
}

/// A pose every 10 ms.
PoseTrack path(const Pose& start, const Velocity& velocity) {
    PoseTrack track(start);
    for (Time time = 9900ms; time <= 10'100ms; time += 10ms)
        track.append(time, moved(start, velocity, seconds(time)));
    return track;
}

Velocity along_x(double mps) {
    return {{mps, 0, 0}, {0, 0, 0}};
}

std::vector<Part> parts_at_origin(std::span<const Mover> movers) {
    const Pose origin;
    return parts_of_sweep(spec(), {&origin, 1}, fired, movers);
}

/// How many parts a model of 0.3 m makes.
std::size_t parts_for(const PoseTrack& track) {
    const Mover mover{0, 0.3, &track};
    return parts_at_origin({&mover, 1}).size();
}

TEST(Encounters, LeaveASweepWholeWhereNothingMoves) {
    const std::vector<Part> parts = parts_at_origin({});
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].beams.first, 0U);
    EXPECT_EQ(parts[0].beams.count, 1081U);
}

TEST(Encounters, PutAModelWhereItIsWhenTheBeamsPass) {
    // Ahead, at 5 m: met by 35 beams on each side of the middle one, in which it moves 1.2 mm.
    const PoseTrack crossing = path(pose_from_rpy({5, 0, 0}, {0, 0, 0}), along_x(0.5));
    const Mover mover{0, 0.3, &crossing};
    const std::vector<Part> parts = parts_at_origin({&mover, 1});
    ASSERT_EQ(parts.size(), 1U);
    ASSERT_EQ(parts[0].updates.size(), 1U);
    EXPECT_NEAR(seconds(parts[0].updates[0].time), seconds(fired(540)), 1e-4);
}

TEST(Encounters, TakeMorePartsWhereSomethingNearIsFast) {
    const Pose ahead = pose_from_rpy({2, 0, 0}, {0, 0, 0});
    EXPECT_EQ(parts_for(path(ahead, along_x(0.1))), 1U);
    EXPECT_GE(parts_for(path(ahead, along_x(5.0))), 7U);
    // Around the scanner it may be met all the time, and moves 18.75 mm.
    const std::size_t around = parts_for(path(Pose{}, along_x(1.0)));
    EXPECT_GE(around, 18U);
    EXPECT_LE(around, 22U);
}

TEST(Encounters, DoNotCareForWhatNoBeamCanMeet) {
    const Velocity fast = along_x(10.0);
    EXPECT_EQ(parts_for(path(pose_from_rpy({-5, 0, 0}, {0, 0, 0}), fast)), 1U);  // behind
    EXPECT_EQ(parts_for(path(pose_from_rpy({0, 12, 0}, {0, 0, 0}), fast)), 1U);  // too far away
    EXPECT_EQ(parts_for(path(pose_from_rpy({2, 0, 1}, {0, 0, 0}), fast)), 1U);   // above
    EXPECT_GT(parts_for(path(pose_from_rpy({2, 0, 0}, {0, 0, 0}), fast)), 1U);
}

TEST(Encounters, BreakASweepOnceForAJump) {
    PoseTrack jumping(pose_from_rpy({2, 0, 0}, {0, 0, 0}));
    jumping.jump(fired(500), pose_from_rpy({3, 0, 0}, {0, 0, 0}));
    const Mover mover{0, 0.3, &jumping};
    const std::vector<Part> parts = parts_at_origin({&mover, 1});
    std::vector<double> met_at_m;
    for (const Part& part : parts) {
        ASSERT_EQ(part.updates.size(), 1U);
        const double x_m = jumping.at(part.updates[0].time).translation_m.x;
        met_at_m.insert(met_at_m.end(), part.beams.count, x_m);
    }
    EXPECT_LE(parts.size(), 3U);
    ASSERT_EQ(met_at_m.size(), 1081U);
    EXPECT_EQ(met_at_m[499], 2.0);
    EXPECT_EQ(met_at_m[500], 3.0);
}

/// From a sensor's origin along its beam.
bool meets(const Pose& sensor, double bearing_rad, const glm::dvec3& middle_m, double radius_m) {
    const glm::dvec3 direction =
        sensor.rotation * glm::dvec3{std::cos(bearing_rad), std::sin(bearing_rad), 0.0};
    const glm::dvec3 to_middle = middle_m - sensor.translation_m;
    const double along_m = std::clamp(glm::dot(to_middle, direction), 0.0, spec().max_range_m);
    return glm::length(to_middle - along_m * direction) <= radius_m;
}

/// How far two points moved at most that are far from each other and from the axis.
double moved_m(const Pose& from, const Pose& to, double radius_m) {
    double most_m = 0.0;
    for (const glm::dvec3& point : {glm::dvec3{radius_m, 0, 0}, glm::dvec3{0, -radius_m, 0}})
        most_m = std::max(most_m, glm::distance(from * point, to * point));
    return most_m;
}

struct Sweep {
    std::function<Time(std::size_t)> fired;
    std::vector<Pose> poses;  ///< one for each beam
    std::vector<Mover> movers;

    [[nodiscard]] std::vector<Part> parts() const {
        return parts_of_sweep(spec(), poses, fired, movers);
    }
};

/// A beam meets a mover's ball now, or it would where the mover has been put.
bool could_meet(const Sweep& sweep, std::size_t beam, const Mover& mover, const Pose& put) {
    const double bearing_rad = spec().angle_rad(static_cast<int>(beam));
    const Pose now = mover.path->at(sweep.fired(beam));
    return meets(sweep.poses[beam], bearing_rad, now.translation_m, mover.radius_m) ||
           meets(sweep.poses[beam], bearing_rad, put.translation_m, mover.radius_m);
}

/// How often beams could meet one, after each has been held against where it is at its own time.
int met_where_they_are(const Sweep& sweep, const std::vector<Part>& parts) {
    std::vector<std::optional<Pose>> put(sweep.movers.size());
    std::size_t beam = 0;
    int met = 0;
    for (const Part& part : parts) {
        EXPECT_EQ(part.beams.first, beam);
        for (const MoverUpdate& one : part.updates)
            put[one.mover] = sweep.movers[one.mover].path->at(one.time);
        for (; beam < part.beams.first + part.beams.count; ++beam) {
            for (std::size_t i = 0; i < sweep.movers.size(); ++i) {
                const Mover& mover = sweep.movers[i];
                if (!could_meet(sweep, beam, mover, put[i].value())) continue;
                ++met;
                const Pose now = mover.path->at(sweep.fired(beam));
                EXPECT_TRUE(std::ranges::count(part.can_meet, mover.id)) << beam << " " << i;
                EXPECT_LE(moved_m(*put[i], now, mover.radius_m), 0.75e-3) << beam << " " << i;
            }
        }
    }
    EXPECT_EQ(beam, 1081U);
    return met;
}

/// A sweep of 100 ms past one.
Sweep slow_sweep_past(const PoseTrack& track, double radius_m) {
    const auto slowly = [](std::size_t beam) { return 10s + 4 * (fired(beam) - 10s); };
    return {slowly, std::vector<Pose>(1081), {{0, radius_m, &track}}};
}

/// Turns 30 times a second, as told every 2 ms until then.
PoseTrack turning(const glm::dvec3& where_m, Time until) {
    constexpr double turn_radps = 30.0 * 2.0 * std::numbers::pi;
    PoseTrack track({}, {.after = PosePolicy::After::extrapolate});
    for (Time time = 9900ms; time <= until; time += 2ms)
        track.append(time, pose_from_rpy(where_m, {0, 0, turn_radps * seconds(time)}));
    return track;
}

/// 5 cm to both sides, 30 times a second, told every 2 ms.
glm::dvec3 vibrating_m(const glm::dvec3& middle_m, Time time) {
    const double phase_rad = 30.0 * 2.0 * std::numbers::pi * seconds(time);
    return middle_m + glm::dvec3{0.0, 0.05 * std::sin(phase_rad), 0.0};
}

PoseTrack vibrating(const glm::dvec3& middle_m) {
    PoseTrack track({});
    for (Time time = 9900ms; time <= 10'200ms; time += 2ms)
        track.append(time, pose_from_rpy(vibrating_m(middle_m, time), {}));
    return track;
}

TEST(Encounters, BreakASweepForEachOfManyJumps) {
    PoseTrack jumping(pose_from_rpy({2, 0, 0}, {}));
    for (int i = 0; i < 40; ++i) {
        const double x_m = i % 2 == 0 ? 3.0 : 2.0;
        const auto beam = static_cast<std::size_t>(450 + 5 * i);
        jumping.jump(fired(beam) + Time{i % 3}, pose_from_rpy({x_m, 0, 0}, {}));
    }
    const Sweep sweep{fired, std::vector<Pose>(1081), {{0, 0.5, &jumping}}};
    const std::vector<Part> parts = sweep.parts();
    EXPECT_GT(met_where_they_are(sweep, parts), 80);
    EXPECT_LE(parts.size(), 41U);
}

TEST(Encounters, FollowWhatJumpsAwayAndBack) {
    PoseTrack jumping(pose_from_rpy({-3, 0, 0}, {}));
    jumping.jump(fired(530), pose_from_rpy({3, 0, 0}, {}));
    jumping.jump(fired(550), pose_from_rpy({-3, 0, 0}, {}));
    const Sweep sweep{fired, std::vector<Pose>(1081), {{0, 0.5, &jumping}}};
    EXPECT_EQ(met_where_they_are(sweep, sweep.parts()), 20);
}

TEST(Encounters, FollowWhatVibratesDuringTheSweep) {
    for (const double x_m : {0.0, 0.6, 2.0}) {
        const PoseTrack track = vibrating({x_m, 0.3, 0.0});
        const Sweep sweep = slow_sweep_past(track, 0.4);
        EXPECT_GT(met_where_they_are(sweep, sweep.parts()), 50) << x_m;
    }
}

TEST(Encounters, SeeWhatVibratesIntoTheBeams) {
    // Where it is at the first, the middle and the last beam, it is above the plane.
    PoseTrack track({});
    for (Time time = 9900ms; time <= 10'200ms; time += 500us) {
        const double phase_rad = 2.0 * std::numbers::pi * seconds(time) / 12.5e-3;
        track.append(time,
                     pose_from_rpy({1.0, 0.0, 0.4 - 0.3 * std::abs(std::sin(phase_rad))}, {}));
    }
    const Sweep sweep = slow_sweep_past(track, 0.3);
    EXPECT_GT(met_where_they_are(sweep, sweep.parts()), 20);
}

TEST(Encounters, FollowWhatTurnsFast) {
    for (const Time until : {10'200ms, 9990ms}) {  // told all the time; goes on by itself
        for (const double x_m : {0.2, 2.0}) {
            const PoseTrack track = turning({x_m, 0.1, 0.0}, until);
            const Sweep sweep = slow_sweep_past(track, 0.4);
            EXPECT_GT(met_where_they_are(sweep, sweep.parts()), 50) << x_m;
        }
    }
}

TEST(Encounters, FollowWhatAShakenSensorSees) {
    const PoseTrack crossing = path(pose_from_rpy({1.5, 0.2, 0}, {}), along_x(2.0));
    Sweep sweep{fired, {}, {{0, 0.2, &crossing}}};
    // Eight times to and fro: an eighth of the sweep sees it at the same place again and again.
    for (std::size_t beam = 0; beam < 1081; ++beam) {
        const double phase_rad = 8.0 * 2.0 * std::numbers::pi * static_cast<double>(beam) / 1080.0;
        sweep.poses.push_back(pose_from_rpy({0, 0, 0}, {0, 0, 0.4 * std::sin(phase_rad)}));
    }
    EXPECT_GT(met_where_they_are(sweep, sweep.parts()), 20);
}

TEST(Encounters, TakeNoPartsForWhatRestsAmongFastOnes) {
    PoseTrack track(pose_from_rpy({0, 1, 0}, {}));  // far from rest only before and after the beams
    track.append(9'990ms, pose_from_rpy({0.5, 1, 0}, {}));
    track.append(9'999ms, pose_from_rpy({2, 0, 0}, {}));
    track.append(10'019ms, pose_from_rpy({2, 0, 0}, {}));
    track.append(10'030ms, pose_from_rpy({0.5, 1, 0}, {}));
    EXPECT_EQ(parts_for(track), 1U);
}

/// Many things on the move around a scanner that moves as well, against each ray and each ball.
class Crowd : public testing::TestWithParam<unsigned> {
  protected:
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(rng_);
    }
    Pose anywhere() {
        return pose_from_rpy({uniform(-8, 8), uniform(-8, 8), uniform(-0.5, 0.5)},
                             {uniform(-0.2, 0.2), uniform(-0.2, 0.2), uniform(-3, 3)});
    }
    Velocity any_velocity(double fastest) {
        const auto one = [&](double most) { return uniform(-most, most); };
        return {{one(fastest), one(fastest), 0.1 * one(fastest)}, {0, 0, one(fastest)}};
    }

    std::mt19937 rng_{GetParam()};
};

TEST_P(Crowd, IsWhereItIsForEachBeamThatCouldMeetIt) {
    const Pose start = anywhere();
    const Velocity drive = any_velocity(2.0);
    std::vector<Pose> poses;
    for (std::size_t beam = 0; beam < 1081; ++beam)
        poses.push_back(moved(start, drive, seconds(fired(beam))));
    std::vector<PoseTrack> tracks;
    for (int i = 0; i < 30; ++i)
        tracks.push_back(path(anywhere(), any_velocity(uniform(0, 3))));
    std::vector<Mover> movers;
    for (const PoseTrack& track : tracks)
        movers.push_back({static_cast<ModelId>(movers.size()), uniform(0.05, 1.0), &track});

    const Sweep sweep{fired, poses, movers};
    const std::vector<Part> parts = sweep.parts();
    const int met = met_where_they_are(sweep, parts);
    EXPECT_GT(met, 5);
    // Rather few for what moves 3 m/s past 30 times.
    EXPECT_LT(parts.size(), 80U);
}

std::size_t beams_of(const std::vector<Passing>& passings) {
    std::size_t beams = 0;
    for (const Passing& one : passings)
        beams += one.beams.count;
    return beams;
}

// Walls stand around at ranges that differ from beam to beam; some beams meet none.
TEST_P(Crowd, PassesEachBeamInFrontOfWhoseWallItCouldBe) {
    Sweep sweep{fired, {}, {}};
    const Pose start = anywhere();
    const Velocity drive = any_velocity(2.0);
    Scan scan;
    for (std::size_t beam = 0; beam < 1081; ++beam) {
        sweep.poses.push_back(moved(start, drive, seconds(fired(beam))));
        const float wall_m = 3.0F + 2.5F * std::sin(0.02F * static_cast<float>(beam));
        scan.hits.push_back(beam % 400 < 20 ? Hit{} : Hit{wall_m, 1.0F, 0, 0});
    }
    scan.world_from_sensor = sweep.poses;
    std::vector<PoseTrack> tracks;
    for (int i = 0; i < 100; ++i)
        tracks.push_back(path(anywhere(), any_velocity(uniform(0, 3))));
    for (const PoseTrack& track : tracks)
        sweep.movers.push_back(
            {static_cast<ModelId>(sweep.movers.size()), uniform(0.05, 1.0), &track});

    const auto passings_now = [&] {
        return passings_of_sweep(spec(), motion_of(sweep.poses), scan, fired, sweep.movers);
    };
    const auto passings = passings_now();
    int met = 0;
    for (std::size_t i = 0; i < sweep.movers.size(); ++i) {
        const Mover& mover = sweep.movers[i];
        for (std::size_t beam = 0; beam < 1081; ++beam) {
            const Pose now = mover.path->at(fired(beam));
            const double bearing_rad = spec().angle_rad(static_cast<int>(beam));
            const double nearest_m =
                glm::distance(now.translation_m, sweep.poses[beam].translation_m) - mover.radius_m;
            if (nearest_m > scan.hits[beam].range_m ||
                !meets(sweep.poses[beam], bearing_rad, now.translation_m, mover.radius_m))
                continue;
            ++met;
            const auto passing = std::ranges::find_if(passings, [&](const Passing& one) {
                return one.mover == i && one.beams.first <= beam &&
                       beam < one.beams.first + one.beams.count;
            });
            ASSERT_NE(passing, passings.end()) << beam << " " << i;
            EXPECT_LE(moved_m(mover.path->at(passing->time), now, mover.radius_m), 0.75e-3);
        }
    }
    EXPECT_GT(met, 5);
    scan.hits.assign(1081, Hit{});
    EXPECT_LT(beams_of(passings), beams_of(passings_now())) << "walls hide nothing";
}

INSTANTIATE_TEST_SUITE_P(Many, Crowd, testing::Range(0U, 50U));

}  // namespace
}  // namespace scipd::sim
