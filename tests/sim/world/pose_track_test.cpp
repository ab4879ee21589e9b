// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/pose_track.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

using namespace std::chrono_literals;

Pose at_x(double x, double yaw_rad = 0.0) {
    return pose_from_rpy({x, 0, 0}, {0, 0, yaw_rad});
}

double x_of(const Pose& pose) {
    return pose.translation_m.x;
}

TEST(PoseTrack, HoldsTheStartForever) {
    const PoseTrack track(at_x(7));
    EXPECT_EQ(track.at(-1h), at_x(7));
    EXPECT_EQ(track.at(0s), at_x(7));
    EXPECT_EQ(track.at(100h), at_x(7));
    EXPECT_TRUE(track.still(-1h, 100h));
}

// The start pose has no time, so there is nothing to interpolate from.
TEST(PoseTrack, HoldsTheStartUntilTheFirstPose) {
    PoseTrack track(at_x(7));
    ASSERT_TRUE(track.append(10s, at_x(1)));
    EXPECT_EQ(track.at(10s - 1ns), at_x(7));
    EXPECT_EQ(track.at(10s), at_x(1));
}

TEST(PoseTrack, InterpolatesHalfWay) {
    PoseTrack track(at_x(0));
    track.append(1s, at_x(0, 0.0));
    track.append(2s, at_x(4, 1.0));
    const Pose half_way = track.at(1500ms);
    EXPECT_NEAR(x_of(half_way), 2.0, 1e-12);
    const glm::dvec3 forward = half_way.rotation * glm::dvec3{1, 0, 0};
    EXPECT_NEAR(std::atan2(forward.y, forward.x), 0.5, 1e-12);
}

TEST(PoseTrack, GivesAppendedPosesExactly) {
    PoseTrack track(at_x(0));
    for (int i = 1; i < 10; ++i)
        track.append(i * 10ms, at_x(i, 0.3 * i));
    for (int i = 1; i < 10; ++i)
        EXPECT_NEAR(x_of(track.at(i * 10ms)), i, 1e-12);
}

TEST(PoseTrack, HoldsTheLast) {
    PoseTrack track(at_x(0));
    track.append(1s, at_x(1));
    track.append(2s, at_x(2));
    EXPECT_EQ(track.at(2s), at_x(2));
    EXPECT_EQ(track.at(1h), at_x(2));
    EXPECT_EQ(track.last(), at_x(2));
}

TEST(PoseTrack, RefusesWhatIsNotLater) {
    PoseTrack track(at_x(0));
    ASSERT_TRUE(track.append(2s, at_x(2)));
    EXPECT_FALSE(track.append(2s, at_x(9)));
    EXPECT_FALSE(track.append(1s, at_x(9)));
    EXPECT_EQ(track.last(), at_x(2));
    EXPECT_EQ(track.at(2s), at_x(2));
}

TEST(PoseTrack, TakesTimesBeforeTheEpoch) {
    PoseTrack track(at_x(0));
    EXPECT_TRUE(track.append(-2s, at_x(1)));
    EXPECT_TRUE(track.append(-1s, at_x(3)));
    EXPECT_NEAR(x_of(track.at(-1500ms)), 2.0, 1e-12);
}

// Stamps of a pose stream may be seconds since 1970: half a second there must still be half a
// second.
TEST(PoseTrack, IsExactFarFromTheEpoch) {
    PoseTrack track(at_x(0));
    const Time now = 1'760'000'000s;
    track.append(now, at_x(0));
    track.append(now + 1ms, at_x(1));
    EXPECT_NEAR(x_of(track.at(now + 250us)), 0.25, 1e-12);
}

TEST(PoseTrack, DoesNotInterpolateAcrossAJump) {
    PoseTrack track(at_x(0));
    track.append(1s, at_x(1));
    track.jump(3s, at_x(100));
    EXPECT_EQ(track.at(2s), at_x(1));
    EXPECT_EQ(track.at(3s - 1ns), at_x(1));
    EXPECT_EQ(track.at(3s), at_x(100));
    EXPECT_EQ(track.at(4s), at_x(100));
}

TEST(PoseTrack, KeepsWhatWasUnderWayBeforeAJump) {
    PoseTrack track(at_x(0));
    track.append(1s, at_x(0));
    track.append(3s, at_x(2));
    track.jump(2s, at_x(50));
    EXPECT_NEAR(x_of(track.at(1500ms)), 0.5, 1e-8);
    EXPECT_EQ(track.at(2s), at_x(50));
    EXPECT_EQ(track.at(3s), at_x(50));  // what was appended for later is gone
}

TEST(PoseTrack, JumpsBeforeEverythingItKnows) {
    PoseTrack track(at_x(0), {}, 4);
    for (int i = 0; i < 5; ++i)
        track.append(10s + i * 1s, at_x(i));
    track.jump(1s, at_x(3));
    EXPECT_EQ(track.at(0s), at_x(3));
    EXPECT_EQ(track.at(20s), at_x(3));
}

TEST(PoseTrack, AppendsAfterAJump) {
    PoseTrack track(at_x(0));
    track.jump(1s, at_x(10));
    EXPECT_TRUE(track.append(2s, at_x(20)));
    EXPECT_NEAR(x_of(track.at(1500ms)), 15.0, 1e-12);
    EXPECT_EQ(track.at(999ms), at_x(0));
}

TEST(PoseTrack, ForgetsTheOldestFirst) {
    PoseTrack track(at_x(0), {}, 4);
    for (int i = 1; i <= 10; ++i)
        track.append(i * 1s, at_x(i));
    EXPECT_EQ(track.at(10s), at_x(10));
    EXPECT_NEAR(x_of(track.at(8500ms)), 8.5, 1e-12);
    EXPECT_EQ(track.at(1s), at_x(7));  // holds the oldest that it still knows
}

TEST(PoseTrack, FindsOldTimesAsWellAsNewOnes) {
    PoseTrack track(at_x(0));
    for (int i = 1; i <= 1000; ++i)
        track.append(i * 1s, at_x(i));
    for (int i = 1; i < 1000; ++i) {
        EXPECT_NEAR(x_of(track.at(i * 1s)), i, 1e-12);
        EXPECT_NEAR(x_of(track.at(i * 1s + 250ms)), i + 0.25, 1e-12);
    }
}

TEST(PoseTrack, IsStillWhereNothingChanges) {
    PoseTrack track(at_x(0));
    track.append(1s, at_x(1));
    track.append(2s, at_x(1));
    track.append(3s, at_x(2));
    EXPECT_TRUE(track.still(1s, 2s));
    EXPECT_TRUE(track.still(1200ms, 1900ms));
    EXPECT_TRUE(track.still(3s, 1h));
    EXPECT_TRUE(track.still(4s, 5s));
    EXPECT_FALSE(track.still(1500ms, 2500ms));
    EXPECT_FALSE(track.still(2100ms, 2200ms));  // under way the whole time
    EXPECT_FALSE(track.still(500ms, 1500ms));   // the jump from the start
    EXPECT_TRUE(track.still(0s, 999ms));
}

TEST(PoseTrack, TellsEachJumpAsAShortLeg) {
    PoseTrack track(at_x(0));
    track.append(1s, at_x(1));  // nobody knows when the start was left
    track.append(2s, at_x(2));
    track.jump(3s, at_x(5));
    track.jump(4s, at_x(5));  // to where it is
    track.jump(5s, at_x(7));
    const auto jumps = [&](Time from, Time to) {
        std::vector<Time> times;
        for (const PoseTrack::Leg& leg : track.legs(from, to))
            if (leg.end - leg.begin == 1ns) times.push_back(leg.end);
        return times;
    };
    EXPECT_EQ(jumps(-1h, 1h), (std::vector<Time>{1s, 3s, 5s}));
    EXPECT_EQ(jumps(1s, 1h), (std::vector<Time>{3s, 5s}));
    EXPECT_EQ(jumps(5s, 1h), std::vector<Time>{});
    EXPECT_EQ(jumps(1s, 3s - 1ns), std::vector<Time>{});
    EXPECT_EQ(jumps(1s, 3s), std::vector<Time>{3s});
}

TEST(PoseTrack, TellsTheLegsOfItsWayWithinASpan) {
    PoseTrack track(at_x(0));
    track.append(1s, at_x(1));
    track.append(2s, pose_from_rpy({3, 0, 0}, {0, 0, 2}));
    track.append(3s, pose_from_rpy({3, 0, 0}, {0, 0, 2}));
    track.append(4s, at_x(2));
    const std::vector<PoseTrack::Leg> legs = track.legs(1500ms, 3250ms);
    ASSERT_EQ(legs.size(), 2U);
    EXPECT_EQ(legs[0].begin, 1500ms);
    EXPECT_EQ(legs[0].end, 2s);
    EXPECT_NEAR(legs[0].from_m.x, 2.0, 1e-12);
    EXPECT_NEAR(legs[0].to_m.x, 3.0, 1e-12);
    EXPECT_NEAR(legs[0].turned_rad, 1.0, 1e-9);
    EXPECT_EQ(legs[1].begin, 3s);
    EXPECT_EQ(legs[1].end, 3250ms);
    EXPECT_NEAR(legs[1].to_m.x, 2.75, 1e-12);
    EXPECT_NEAR(legs[1].turned_rad, 0.5, 1e-9);
    EXPECT_TRUE(track.legs(2s, 3s).empty());
    EXPECT_TRUE(track.legs(1500ms, 1500ms).empty());
    EXPECT_TRUE(track.legs(4s, 1h).empty());
}

TEST(PoseTrack, GoesOnForOneLegUntilItIsStale) {
    PoseTrack track(at_x(0), {.after = PosePolicy::After::extrapolate});
    track.append(1s, at_x(1));
    track.append(1100ms, pose_from_rpy({1.2, 0, 0}, {0, 0, 3}));
    const std::vector<PoseTrack::Leg> legs = track.legs(1200ms, 1h);
    ASSERT_EQ(legs.size(), 1U);
    EXPECT_EQ(legs[0].begin, 1200ms);
    EXPECT_EQ(legs[0].end, 1600ms);
    EXPECT_NEAR(legs[0].from_m.x, 1.4, 1e-9);
    EXPECT_NEAR(legs[0].to_m.x, 2.2, 1e-9);
    EXPECT_NEAR(legs[0].turned_rad, 12.0, 1e-9);  // nearly two turns
    EXPECT_TRUE(track.legs(1600ms, 1h).empty());
}

TEST(PoseTrack, IsNotStillAcrossAJumpAndBack) {
    PoseTrack track(at_x(1));
    track.jump(1s, at_x(2));
    track.jump(2s, at_x(1));
    EXPECT_FALSE(track.still(500ms, 2500ms));
    EXPECT_TRUE(track.still(2s, 3s));
}

TEST(PoseTrack, JumpsWhereNothingMovesSoFast) {
    PoseTrack track(at_x(0), {.fastest_mps = 5.0});
    ASSERT_TRUE(track.place(1s, at_x(1)));
    ASSERT_TRUE(track.place(1100ms, at_x(1.5)));  // 5 m/s
    EXPECT_NEAR(x_of(track.at(1050ms)), 1.25, 1e-9);
    ASSERT_TRUE(track.place(1200ms, at_x(2.1)));  // 6 m/s
    EXPECT_EQ(track.at(1200ms - 1ns), at_x(1.5));
    EXPECT_EQ(track.at(1200ms), at_x(2.1));
    EXPECT_FALSE(track.place(1200ms, at_x(3)));
}

TEST(PoseTrack, JumpsWherePosesAreTooFarApartInTime) {
    PoseTrack track(at_x(0), {.longest_gap = 200ms});
    track.place(1s, at_x(1));
    track.place(1200ms, at_x(2));
    track.place(1401ms, at_x(3));
    EXPECT_NEAR(x_of(track.at(1100ms)), 1.5, 1e-9);
    EXPECT_EQ(track.at(1400ms), at_x(2));
}

TEST(PoseTrack, GoesOnAsItMovedUntilItIsStale) {
    PoseTrack track(at_x(0), {.after = PosePolicy::After::extrapolate, .stale_after = 300ms});
    track.place(1s, at_x(0, 0.0));
    track.place(1100ms, at_x(0.2, 0.1));  // 2 m/s, 1 rad/s
    const Pose ahead = track.at(1300ms);
    EXPECT_NEAR(x_of(ahead), 0.6, 1e-9);
    const glm::dvec3 forward = ahead.rotation * glm::dvec3{1, 0, 0};
    EXPECT_NEAR(std::atan2(forward.y, forward.x), 0.3, 1e-9);
    EXPECT_NEAR(x_of(track.at(5s)), 0.8, 1e-9);
    EXPECT_FALSE(track.still(1200ms, 1210ms));
    EXPECT_FALSE(track.still(1390ms, 1410ms));
    EXPECT_TRUE(track.still(1400ms, 2s));
}

// The poses of a robot at 1 m/s come 20 ms apart, but for one that was held up until the next.
TEST(PoseTrack, GoesOnAsItMovedThoughTwoPosesCameTogether) {
    PoseTrack track(at_x(0), {.after = PosePolicy::After::extrapolate});
    for (int i = 0; i < 10; ++i)
        ASSERT_TRUE(track.place(1s + i * 20ms, at_x(0.02 * i)));
    ASSERT_TRUE(track.place(1218ms, at_x(0.20)));
    ASSERT_TRUE(track.place(1220ms, at_x(0.22)));
    EXPECT_NEAR(x_of(track.at(1240ms)), 0.24, 0.002);
    ASSERT_TRUE(track.place(1240ms, at_x(0.22)));
    EXPECT_EQ(track.at(2s), at_x(0.22));  // it rests
    ASSERT_TRUE(track.place(1250ms, at_x(5.0)));
    ASSERT_TRUE(track.place(1260ms, at_x(5.01)));
    EXPECT_NEAR(x_of(track.at(1270ms)), 5.02, 1e-9);  // only poses after a jump count
}

TEST(PoseTrack, GoesOnWithTheVelocityThatItIsTold) {
    PoseTrack track(at_x(0), {.after = PosePolicy::After::extrapolate, .stale_after = 10s});
    track.place(1s, at_x(1), Velocity{{0, 3, 0}, {0, 0, -2}});
    const Pose ahead = track.at(1500ms);
    EXPECT_NEAR(x_of(ahead), 1.0, 1e-12);
    EXPECT_NEAR(ahead.translation_m.y, 1.5, 1e-12);
    const glm::dvec3 forward = ahead.rotation * glm::dvec3{1, 0, 0};
    EXPECT_NEAR(std::atan2(forward.y, forward.x), -1.0, 1e-12);
}

// What it had assumed stays what it was: a scan that is made later is made of the same poses.
TEST(PoseTrack, KeepsWhatItHadAssumedBeforeAJump) {
    PoseTrack track(at_x(0), {.after = PosePolicy::After::extrapolate, .stale_after = 200ms});
    track.place(1s, at_x(0));
    track.place(1100ms, at_x(0.1));
    const double soon = x_of(track.at(1200ms));
    const double later = x_of(track.at(2s));
    track.place(5s, at_x(40));
    EXPECT_NEAR(x_of(track.at(1200ms)), soon, 1e-9);
    EXPECT_NEAR(x_of(track.at(2s)), later, 1e-9);
    EXPECT_EQ(track.at(5s), at_x(40));
}

TEST(PoseTrack, IsNowhereBeforeTheFirstPoseIfToldSo) {
    PoseTrack track(at_x(7), {.absent_before = true});
    EXPECT_TRUE(track.absent(0s));
    EXPECT_FALSE(track.live(0s));
    track.place(10s, at_x(1));
    EXPECT_TRUE(track.absent(10s - 1ns));
    EXPECT_FALSE(track.absent(10s));
    EXPECT_FALSE(track.absent(1h));
    EXPECT_TRUE(track.live(10s));
}

TEST(PoseTrack, IsNowhereWhileItsStreamIsStaleIfToldSo) {
    PoseTrack track(at_x(7), {.after = PosePolicy::After::absent, .stale_after = 300ms});
    EXPECT_FALSE(track.absent(0s));
    track.place(1s, at_x(1));
    EXPECT_FALSE(track.absent(1300ms));
    EXPECT_TRUE(track.absent(1301ms));
    EXPECT_FALSE(track.live(1301ms));
    track.place(5s, at_x(2));
    EXPECT_FALSE(track.absent(1300ms));
    EXPECT_TRUE(track.absent(3s));
    EXPECT_FALSE(track.absent(5s));
    track.place(5900ms, at_x(3));  // a slow stream is none that has ended
    EXPECT_FALSE(track.absent(5800ms));
}

}  // namespace
}  // namespace scipd::sim
