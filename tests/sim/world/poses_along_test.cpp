// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Holds poses_along() against PoseTrack::at(), which works each pose out by itself.
#include "sim/world/poses_along.h"

#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

using namespace std::chrono_literals;

const Pose mount = pose_from_rpy({0.2, -0.1, 0.35}, {0.1, -0.2, 3.0});

std::vector<Time> every(Time step, Time from, Time to) {
    std::vector<Time> times;
    for (Time time = from; time <= to; time += step)
        times.push_back(time);
    return times;
}

/// The arc and the chord, which at() takes for short turns, are as far apart as this.
void expect_same(const PoseTrack& track, const std::vector<Time>& times, double apart_rad = 2e-6) {
    const std::vector<Pose> poses = poses_along(track, mount, times);
    ASSERT_EQ(poses.size(), times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
        const Pose one = track.at(times[i]) * mount;
        EXPECT_LT(glm::distance(poses[i].translation_m, one.translation_m), apart_rad)
            << times[i].count();
        const auto twist = poses[i].rotation * glm::conjugate(one.rotation);
        EXPECT_LT(2.0 * glm::length(glm::dvec3(twist.x, twist.y, twist.z)), apart_rad)
            << times[i].count();
        EXPECT_NEAR(glm::length(poses[i].rotation), 1.0, 1e-9);
    }
}

// A closed form: a quarter of a circle around the origin, the mount a metre ahead.
TEST(PosesAlong, FollowTheArc) {
    PoseTrack track({});
    track.append(1s, {});
    track.append(2s, pose_from_rpy({}, {0, 0, 1.5}));
    const std::vector<Time> times = every(1ms, 1s, 2s - 1ns);
    const std::vector<Pose> poses = poses_along(track, pose_from_rpy({1, 0, 0}, {}), times);
    for (std::size_t i = 0; i < times.size(); ++i) {
        const double yaw_rad = 1.5e-3 * static_cast<double>(i);
        EXPECT_NEAR(poses[i].translation_m.x, std::cos(yaw_rad), 1e-10);
        EXPECT_NEAR(poses[i].translation_m.y, std::sin(yaw_rad), 1e-10);
        EXPECT_NEAR(poses[i].rotation.z, std::sin(yaw_rad / 2), 1e-10);
    }
}

TEST(PosesAlong, AreThoseOfARobotThatDrivesAnywhere) {
    std::mt19937 chance(7);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same each time
    std::uniform_real_distribution<double> some(-1.0, 1.0);
    for (const double fastest : {0.0, 0.01, 0.1, 1.0}) {
        PoseTrack track({});
        Pose at = pose_from_rpy({3, 4, 5}, {1, -1, 2});
        for (Time time = 1s; time < 2s; time += 20ms) {
            track.place(time, at);
            const Pose step = pose_from_rpy(
                {fastest * some(chance), fastest * some(chance), fastest * some(chance)},
                {fastest * some(chance), fastest * some(chance), fastest * some(chance)});
            at = at * step;
        }
        expect_same(track, every(77'777ns, 990ms, 2100ms));
    }
}

// Also in the nanosecond in which it is nowhere in between.
TEST(PosesAlong, JumpWhereTheRobotJumps) {
    PoseTrack track({});
    track.place(1s, pose_from_rpy({1, 0, 0}, {}));
    track.jump(1100ms, pose_from_rpy({50, 0, 0}, {0, 0, 3}));
    expect_same(track, every(1ms, 900ms, 1200ms));
    expect_same(track, every(1ns, 1100ms - 5ns, 1100ms + 5ns));
}

TEST(PosesAlong, GoOnWithTheLastVelocityUntilTheStreamIsStale) {
    PoseTrack track({}, {.after = PosePolicy::After::extrapolate, .stale_after = 300ms});
    track.place(1s, pose_from_rpy({1, 0, 0}, {}));
    track.place(1010ms, pose_from_rpy({1.01, 0, 0}, {0, 0, 0.2}));  // 20 rad/s
    expect_same(track, every(1ms, 990ms, 1500ms));
}

TEST(PosesAlong, AreTheSameToTheLastBitAtRest) {
    PoseTrack track({});
    track.place(1s, pose_from_rpy({1, 2, 3}, {0.1, 0.2, 0.3}));
    track.place(1100ms, pose_from_rpy({1, 2, 3}, {0.1, 0.2, 0.3}));
    track.place(1200ms, pose_from_rpy({1.1, 2, 3}, {0.1, 0.2, 0.3}));
    const std::vector<Time> times = every(1ms, 1s, 1300ms);
    const std::vector<Pose> poses = poses_along(track, mount, times);
    for (std::size_t i = 0; i < 100; ++i)
        EXPECT_EQ(poses[i], track.at(times[i]) * mount);
    EXPECT_EQ(poses.back(), track.at(1300ms) * mount);
}

TEST(PosesAlong, MayShareATime) {
    PoseTrack track({});
    track.place(1s, {});
    track.place(1100ms, pose_from_rpy({0.1, 0, 0}, {0, 0, 0.1}));
    expect_same(track, {1s, 1s, 1050ms, 1050ms, 1050ms, 1100ms, 1100ms});
    EXPECT_TRUE(poses_along(track, mount, {}).empty());
}

}  // namespace
}  // namespace scipd::sim
