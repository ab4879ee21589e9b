// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/pose.h"

namespace scipd::sim {

Pose operator*(const Pose& a_from_b, const Pose& b_from_c) {
    return {a_from_b * b_from_c.translation_m, a_from_b.rotation * b_from_c.rotation};
}

glm::dvec3 operator*(const Pose& target_from_source, const glm::dvec3& p_source) {
    return target_from_source.rotation * p_source + target_from_source.translation_m;
}

Pose inverse(const Pose& target_from_source) {
    const glm::dquat source_from_target = glm::conjugate(target_from_source.rotation);
    return {-(source_from_target * target_from_source.translation_m), source_from_target};
}

Pose pose_from_rpy(const glm::dvec3& xyz_m, const glm::dvec3& rpy_rad) {
    const glm::dquat roll = glm::angleAxis(rpy_rad.x, glm::dvec3{1.0, 0.0, 0.0});
    const glm::dquat pitch = glm::angleAxis(rpy_rad.y, glm::dvec3{0.0, 1.0, 0.0});
    const glm::dquat yaw = glm::angleAxis(rpy_rad.z, glm::dvec3{0.0, 0.0, 1.0});
    return {xyz_m, yaw * pitch * roll};
}

Pose interpolate(const Pose& a, const Pose& b, double share) {
    // GLM takes the shorter arc, but goes over to a chord where the two are nearly equal, which
    // shortens the result.
    return {glm::mix(a.translation_m, b.translation_m, share),
            glm::normalize(glm::slerp(a.rotation, b.rotation, share))};
}

}  // namespace scipd::sim
