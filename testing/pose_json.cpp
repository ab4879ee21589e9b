// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "testing/pose_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace scipd::testing {
namespace {

using Quaternion = std::array<double, 4>;

/// A rotation by roll about x, then by pitch about y, then by yaw about z.
Quaternion quaternion_of(const Pose& pose) {
    const double cr = std::cos(pose.roll_rad / 2), sr = std::sin(pose.roll_rad / 2);
    const double cp = std::cos(pose.pitch_rad / 2), sp = std::sin(pose.pitch_rad / 2);
    const double cy = std::cos(pose.yaw_rad / 2), sy = std::sin(pose.yaw_rad / 2);
    return {sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy,
            cr * cp * cy + sr * sp * sy};
}

/// Shoemake's way, the short way round.
Quaternion slerp(const Quaternion& from, const Quaternion& to, double share) {
    double dot = 0;
    for (std::size_t i = 0; i < from.size(); ++i)
        dot += from[i] * to[i];
    const double angle = std::acos(std::min(1.0, std::abs(dot)));
    constexpr double hardly_rad = 1e-6;
    if (angle < hardly_rad) return from;
    const double of_from = std::sin((1 - share) * angle) / std::sin(angle);
    const double of_to = std::copysign(std::sin(share * angle) / std::sin(angle), dot);
    Quaternion q{};
    for (std::size_t i = 0; i < q.size(); ++i)
        q[i] = of_from * from[i] + of_to * to[i];
    return q;
}

}  // namespace

Json json_of(const Pose& pose) {
    return {{"xyz", {pose.x_m, pose.y_m, pose.z_m}}, {"q", quaternion_of(pose)}};
}

Pose pose_in(const Json& json) {
    const std::array<double, 3> at = json.at("xyz");
    const auto [x, y, z, w] = json.at("q").get<Quaternion>();
    return {at[0],
            at[1],
            at[2],
            std::atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
            std::asin(std::clamp(2 * (w * y - z * x), -1.0, 1.0)),
            std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))};
}

Json between(const Json& from, const Json& to, double share) {
    std::array<double, 3> xyz = from.at("xyz");
    const std::array<double, 3> end = to.at("xyz");
    for (std::size_t i = 0; i < xyz.size(); ++i)
        xyz[i] += share * (end[i] - xyz[i]);
    const Quaternion q = slerp(from.at("q").get<Quaternion>(), to.at("q").get<Quaternion>(), share);
    return {{"xyz", xyz}, {"q", q}};
}

}  // namespace scipd::testing
