// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A rigid transform, in double precision: worlds may lie far from their origin, and only a backend
// goes down to float. Values; no thread rule.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace scipd::sim {

/// Reads target_from_source: p_target = rotation * p_source + translation. Frames: x forward, y
/// left, z up, metres.
struct Pose {
    glm::dvec3 translation_m{0.0, 0.0, 0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< unit length; GLM's order is w, x, y, z

    bool operator==(const Pose&) const = default;
};

/// a_from_c = a_from_b * b_from_c
Pose operator*(const Pose& a_from_b, const Pose& b_from_c);

/// The point p, given in the source frame, in the target frame.
glm::dvec3 operator*(const Pose& target_from_source, const glm::dvec3& p_source);

Pose inverse(const Pose& target_from_source);

/// Roll, pitch, yaw in radians about the fixed x, y, z axes, in that order (as in SDF and URDF).
Pose pose_from_rpy(const glm::dvec3& xyz_m, const glm::dvec3& rpy_rad);

/// How fast a body moves and turns, both in W.
struct Velocity {
    glm::dvec3 linear_mps{0.0, 0.0, 0.0};
    glm::dvec3 angular_radps{0.0, 0.0, 0.0};  ///< about its own origin

    bool operator==(const Velocity&) const = default;
};

/// Where a body is after so long at this velocity, and which velocity brings it from a to b.
Pose moved(const Pose& pose, const Velocity& velocity, double seconds);
Velocity velocity_between(const Pose& a, const Pose& b, double seconds);

/// The shorter way from one to the other.
double angle_between_rad(const glm::dquat& a, const glm::dquat& b);

/// Linear in translation, slerp along the shorter arc in rotation; share 0 gives a, 1 gives b.
Pose interpolate(const Pose& a, const Pose& b, double share);

}  // namespace scipd::sim
