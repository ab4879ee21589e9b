// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/pose.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

constexpr double quarter_turn = std::numbers::pi / 2.0;

void expect_point(const glm::dvec3& point, double x, double y, double z) {
    EXPECT_NEAR(point.x, x, 1e-12);
    EXPECT_NEAR(point.y, y, 1e-12);
    EXPECT_NEAR(point.z, z, 1e-12);
}

TEST(Pose, IsTheIdentityByDefault) {
    expect_point(Pose{} * glm::dvec3{1, 2, 3}, 1, 2, 3);
}

TEST(Pose, YawTurnsForwardToTheLeft) {
    expect_point(pose_from_rpy({10, 0, 0}, {0, 0, quarter_turn}) * glm::dvec3{1, 0, 0}, 10, 1, 0);
}

TEST(Pose, PitchTurnsForwardDown) {
    expect_point(pose_from_rpy({0, 0, 0}, {0, quarter_turn, 0}) * glm::dvec3{1, 0, 0}, 0, 0, -1);
}

TEST(Pose, RollTurnsLeftUp) {
    expect_point(pose_from_rpy({0, 0, 0}, {quarter_turn, 0, 0}) * glm::dvec3{0, 1, 0}, 0, 0, 1);
}

// SDF and URDF: first roll, then pitch, then yaw, each about the fixed axes.
TEST(Pose, RollComesFirstAndYawLast) {
    const Pose pose = pose_from_rpy({0, 0, 0}, {quarter_turn, 0, quarter_turn});
    expect_point(pose * glm::dvec3{0, 1, 0}, 0, 0, 1);  // rolled up, then yawed about itself
    expect_point(pose * glm::dvec3{1, 0, 0}, 0, 1, 0);  // not rolled, then yawed to the left
    expect_point(pose * glm::dvec3{0, 0, 1}, 1, 0, 0);  // rolled to the right, then yawed forward
}

TEST(Pose, ChainsFromRightToLeft) {
    const Pose world_from_robot = pose_from_rpy({5, 0, 0}, {0, 0, quarter_turn});
    const Pose robot_from_sensor = pose_from_rpy({0.2, 0, 0.3}, {0, 0, 0});
    expect_point((world_from_robot * robot_from_sensor) * glm::dvec3{1, 0, 0}, 5, 1.2, 0.3);
}

TEST(Pose, InverseUndoes) {
    const Pose pose = pose_from_rpy({1, -2, 3}, {0.3, -0.7, 2.1});
    const glm::dvec3 point{0.5, 4.0, -6.0};
    expect_point(inverse(pose) * (pose * point), point.x, point.y, point.z);
    expect_point((inverse(pose) * pose).translation_m, 0, 0, 0);
}

TEST(Interpolate, GoesStraightAndTurnsEvenly) {
    const Pose a = pose_from_rpy({0, 0, 0}, {0, 0, 0});
    const Pose b = pose_from_rpy({4, 2, -2}, {0, 0, 1.2});
    const Pose quarter = interpolate(a, b, 0.25);
    expect_point(quarter.translation_m, 1.0, 0.5, -0.5);
    expect_point(quarter.rotation * glm::dvec3{1, 0, 0}, std::cos(0.3), std::sin(0.3), 0);
}

TEST(Interpolate, GivesTheEndsAtTheEnds) {
    const Pose a = pose_from_rpy({1, 2, 3}, {0.1, 0.2, 0.3});
    const Pose b = pose_from_rpy({4, 5, 6}, {0.4, 0.5, 0.6});
    const glm::dvec3 point{1, 1, 1};
    EXPECT_LT(glm::distance(interpolate(a, b, 0.0) * point, a * point), 1e-12);
    EXPECT_LT(glm::distance(interpolate(a, b, 1.0) * point, b * point), 1e-12);
}

// q and -q are the same rotation: the arc must not depend on which of the two a driver sends.
TEST(Interpolate, TakesTheShorterArcWhateverTheSign) {
    const Pose a = pose_from_rpy({0, 0, 0}, {0, 0, 3.0});
    Pose b = pose_from_rpy({0, 0, 0}, {0, 0, -3.0});
    for (int sign = 0; sign < 2; ++sign) {
        const glm::dvec3 forward = interpolate(a, b, 0.5).rotation * glm::dvec3{1, 0, 0};
        expect_point(forward, -1, 0, 0);  // half way from 3 to -3 rad over pi
        b.rotation = -b.rotation;
    }
}

// Nearly equal rotations take a short cut; neither its use nor its border may show.
TEST(Interpolate, TurnsEvenlyOverSmallAndLargeAngles) {
    for (const double turn_rad : {1e-9, 0.01, 0.06, 0.0632, 0.0633, 0.07, 0.5, 3.0}) {
        const Pose a = pose_from_rpy({0, 0, 0}, {0, 0, 1.0});
        const Pose b = pose_from_rpy({0, 0, 0}, {0, 0, 1.0 + turn_rad});
        for (const double share : {0.1, 0.2113, 0.5, 0.7887, 0.9}) {
            const glm::dvec3 forward = interpolate(a, b, share).rotation * glm::dvec3{1, 0, 0};
            EXPECT_NEAR(std::atan2(forward.y, forward.x),
                        std::remainder(1.0 + share * turn_rad, 4 * quarter_turn), 2e-6)
                << turn_rad;
        }
    }
}

TEST(Interpolate, KeepsUnitLengthBetweenNearlyEqualRotations) {
    const Pose a = pose_from_rpy({0, 0, 0}, {0, 0, 0});
    const Pose b = pose_from_rpy({0, 0, 0}, {0, 0, 1e-4});
    EXPECT_NEAR(glm::length(interpolate(a, b, 0.5).rotation), 1.0, 1e-15);
}

}  // namespace
}  // namespace scipd::sim
