// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The walks of actors against the splines that Gazebo evaluates, asked as its PoseAnimation asks
// them, and against closed form.
#include "sim/loaders/actors/actor_walk.h"

#include <algorithm>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <ignition/math/Spline.hh>

namespace scipd::sim {
namespace {

using namespace std::chrono_literals;
using Seconds = std::chrono::duration<double>;

Pose at_x(double x_m, double yaw_rad = 0.0) {
    return pose_from_rpy({x_m, 0, 0}, {0, 0, yaw_rad});
}

double x_m(const Script& walk, Time time) {
    return walk.at(0s, time).translation_m.x;
}

/// 1 m/s along x, a waypoint each metre.
ActorTrajectory metres(int count) {
    ActorTrajectory trajectory;
    for (int i = 0; i <= count; ++i)
        trajectory.waypoints.push_back({std::chrono::seconds(i), at_x(i)});
    return trajectory;
}

/// Where Gazebo has it, of a trajectory whose first waypoint is at 0.
class GazebosAnimation {
  public:
    explicit GazebosAnimation(const ActorTrajectory& trajectory)
        : waypoints_(trajectory.waypoints) {
        positions_.AutoCalculate(false);
        positions_.Tension(trajectory.tension);
        for (const Waypoint& waypoint : waypoints_) {
            const auto& p = waypoint.pose.translation_m;
            positions_.AddPoint({p.x, p.y, p.z});
        }
        positions_.RecalcTangents();
    }

    glm::dvec3 at_m(Time time) const {
        const auto next = std::ranges::upper_bound(waypoints_, time, {}, &Waypoint::time);
        if (next == waypoints_.end()) return waypoints_.back().pose.translation_m;
        const Waypoint& before = *std::prev(next);
        const auto index = static_cast<unsigned>(std::prev(next) - waypoints_.begin());
        const double share = Seconds(time - before.time) / Seconds(next->time - before.time);
        const auto p = positions_.Interpolate(index, share);
        return {p.X(), p.Y(), p.Z()};
    }

  private:
    std::vector<Waypoint> waypoints_;
    ignition::math::Spline positions_;
};

ActorTrajectory random_trajectory(std::mt19937& random, double tension, bool closed) {
    std::uniform_real_distribution<double> far_m(-8.0, 8.0);
    std::uniform_real_distribution<double> yaw_rad(-3.0, 3.0);
    std::uniform_int_distribution<int> milliseconds(200, 9000);
    ActorTrajectory trajectory{0, tension, {}};
    Time time{};
    for (int i = 0; i < 9; ++i) {
        trajectory.waypoints.push_back(
            {time, pose_from_rpy({far_m(random), far_m(random), 0}, {0, 0, yaw_rad(random)})});
        time += std::chrono::milliseconds(milliseconds(random));
    }
    if (closed) trajectory.waypoints.back().pose = trajectory.waypoints.front().pose;
    return trajectory;
}

TEST(ActorWalk, GoesWhereGazebosSplinesGo) {
    std::mt19937 random(1);
    for (int i = 0; i < 40; ++i) {
        const ActorTrajectory trajectory = random_trajectory(random, 0.25 * (i % 5), i % 2 == 0);
        const GazebosAnimation gazebo(trajectory);
        const SharedScript walk = walk_of({trajectory}, {}, false);
        for (Time time{}; time <= trajectory.waypoints.back().time; time += 17ms) {
            ASSERT_LT(glm::distance(walk->at(0s, time).translation_m, gazebo.at_m(time)), 1.01e-4)
                << i << " at " << Seconds(time).count();
        }
    }
}

TEST(ActorWalk, TurnsEvenlyByTheShorterWay) {
    const ActorTrajectory trajectory{0, 0.0, {{0s, at_x(0, 3.0)}, {2s, at_x(5, -3.0)}}};
    const SharedScript walk = walk_of({trajectory}, {}, false);
    for (Time time{}; time <= 2s; time += 10ms) {
        const double yaw_rad = 3.0 + (2.0 * std::numbers::pi - 6.0) * Seconds(time).count() / 2.0;
        ASSERT_LT(angle_between_rad(walk->at(0s, time).rotation, at_x(0, yaw_rad).rotation), 1e-6);
    }
}

// Between the first two and the last two of a Catmull-Rom spline it speeds up and slows down.
TEST(ActorWalk, IsEvenAlongEvenWaypoints) {
    const SharedScript walk = walk_of({metres(6)}, {}, false);
    for (Time time = 1s; time <= 5s; time += 10ms)
        ASSERT_NEAR(x_m(*walk, time), Seconds(time).count(), 1e-9);
    EXPECT_NEAR(x_m(*walk, 500ms), 0.4375, 1e-4);  // (-s^3 + 2 s^2 + s) / 2
    EXPECT_NEAR(x_m(*walk, 7s), 6.0, 1e-12);
}

TEST(ActorWalk, WaitsBeforeEachLap) {
    const SharedScript walk = walk_of({metres(6)}, 2s, true);
    EXPECT_EQ(walk->lap, 8s);
    for (const Time lap : {0s, 8s, 80s}) {
        EXPECT_DOUBLE_EQ(x_m(*walk, lap), 0.0);
        EXPECT_DOUBLE_EQ(x_m(*walk, lap + 2s), 0.0);
        EXPECT_NEAR(x_m(*walk, lap + 5s), 3.0, 1e-9);
        EXPECT_NEAR(x_m(*walk, lap + 8s - 1ns), 6.0, 1e-9);
    }
}

TEST(ActorWalk, BeginsWithItsScriptAndStandsBefore) {
    const SharedScript walk = walk_of({metres(6)}, {}, true);
    EXPECT_DOUBLE_EQ(walk->at(10s, 0s).translation_m.x, 0.0);
    EXPECT_DOUBLE_EQ(walk->at(10s, 10s).translation_m.x, 0.0);
    EXPECT_NEAR(walk->at(10s, 13s).translation_m.x, 3.0, 1e-9);
    EXPECT_NEAR(walk->at(10s, 19s).translation_m.x, 3.0, 1e-9);
}

TEST(ActorWalk, TakesOneTrajectoryAfterTheOtherEachFromItsOwnBeginning) {
    ActorTrajectory back = metres(6);
    for (Waypoint& waypoint : back.waypoints) {
        waypoint.pose = at_x(10 - Seconds(waypoint.time).count());
        waypoint.time += 1s;  // it waits
    }
    const SharedScript walk = walk_of({metres(6), back}, {}, true);
    EXPECT_EQ(walk->lap, 13s);
    EXPECT_NEAR(x_m(*walk, 3s), 3.0, 1e-9);
    EXPECT_NEAR(x_m(*walk, 6s - 1ns), 6.0, 1e-9);
    EXPECT_NEAR(x_m(*walk, 6s), 10.0, 1e-9);  // without a way there
    EXPECT_NEAR(x_m(*walk, 7s), 10.0, 1e-9);
    EXPECT_NEAR(x_m(*walk, 10s), 7.0, 1e-9);
    EXPECT_NEAR(x_m(*walk, 16s), 3.0, 1e-9);
}

TEST(ActorWalk, MayStandAllTheTime) {
    const ActorTrajectory here{0, 0.0, {{0s, at_x(3)}}};
    for (const auto& trajectories : {std::vector{here}, std::vector{here, here}}) {
        const SharedScript walk = walk_of(trajectories, 1s, true);
        EXPECT_EQ(walk->lap, 0s);
        EXPECT_DOUBLE_EQ(x_m(*walk, 100s), 3.0);
    }
}

// Steps that fall together would be refused, and what is between them forgotten.
TEST(ActorWalk, HasStepsWhoseTimesGrow) {
    const ActorTrajectory here{0, 0.0, {{0s, at_x(3)}}};
    const ActorTrajectory hurried{0, 0.0, {{0s, at_x(0)}, {1ms, at_x(9)}, {2ms, at_x(-9)}}};
    for (const Time delay : {0s, 1s}) {
        const SharedScript walk = walk_of({here, metres(2), here, hurried, here}, delay, true);
        ASSERT_EQ(walk->steps.front().time, 0s);
        for (std::size_t i = 1; i < walk->steps.size(); ++i)
            ASSERT_LT(walk->steps[i - 1].time, walk->steps[i].time) << i;
        ASSERT_LT(walk->steps.back().time, walk->lap);
    }
}

TEST(ActorWalk, IsNoneWhereNoTimeCouldTellIt) {
    const ActorTrajectory longest{0, 0.0, {{0s, at_x(0)}, {1'000'000'000s, at_x(1)}}};
    EXPECT_NE(walk_of({longest}, {}, true), nullptr);
    EXPECT_EQ(walk_of(std::vector(5, longest), {}, true), nullptr);
}

TEST(ActorWalk, ShowsAnyWindowAsItIs) {
    std::mt19937 random(2);
    const ActorTrajectory trajectory = random_trajectory(random, 0.0, false);
    const SharedScript walk = walk_of({trajectory}, 300ms, true);
    for (Time from = -1s; from < 3 * walk->lap; from += 997ms) {
        const PoseTrack window = walk->between(0s, from, from + 50ms);
        for (Time time = from; time <= from + 50ms; time += 1ms)
            ASSERT_EQ(window.at(time), walk->at(0s, time)) << Seconds(time).count();
    }
}

}  // namespace
}  // namespace scipd::sim
