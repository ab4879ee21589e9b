// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// From directions to pixels and from depths back to ranges: equations (1) and (2) of the
// depth-buffer method. Pure; knows no OpenGL.
//
//        left, a = tan of the angle to the left
//         ^
//         |     .   .   .   .   .     pixel centres, one row of a strip
//         |    a = first.x + x pitch.x
//    eye  +-----------------------> forward     z: the distance along it
//
#pragma once

#include <array>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "sim/world/pose.h"

namespace scipd::sim {

/// Nothing nearer to the eye is seen, as by rays. Scanners tell what is too near, so it has to be
/// seen; a reversed depth of floating point is as exact with so near a plane as with one at a
/// metre.
inline constexpr double near_m = 1e-4;

/// One picture through a pinhole at the sensor: evenly spaced pixels in a plane before it.
struct Strip {
    glm::dvec3 forward{1, 0, 0};  ///< of unit length, in S, as are left and up
    glm::dvec3 left{0, 1, 0};
    glm::dvec3 up{0, 0, 1};
    glm::dvec2 first{0, 0};  ///< tangents to the left and upward of the first pixel's centre
    glm::dvec2 pitch{1e-3, 1e-3};
    glm::ivec2 size_px{1, 1};
};

/// The strip with so many more pixels on all sides.
Strip widened(const Strip& strip, const glm::ivec2& margin_px);

/// Where a direction before the strip falls; whole numbers are the centres of pixels.
glm::dvec2 pixel_of(const Strip& strip, const glm::dvec3& direction);

/// The cosine of eq. (2): range = z / cos_alpha. `direction` is of unit length.
double cos_alpha(const Strip& strip, const glm::dvec3& direction);

/// Takes a point given relative to the eye, along the axes of S: x and y fill the strip, w is z,
/// and depth = near_m / z, which is 1 at the near plane and 0 at infinity.
glm::dmat4 clip_from_sensor(const Strip& strip);

/// Eq. (1), z = f n / (f - d (f - n)), as the far plane f goes to infinity and with d = 1 - depth.
inline double z_of_depth_m(double depth) {
    return near_m / depth;
}

/// The space that a strip sees, from an eye in anchored W: which boxes and triangles can be left
/// out. Four sides through the eye; nothing behind it counts.
class Frustum {
  public:
    Frustum(const Strip& strip, const Pose& anchored_from_sensor);

    [[nodiscard]] const glm::vec3& eye_m() const { return eye_m_; }

    enum class Place {
        beyond,  ///< nothing of it can be seen
        across,  ///< some of it may lie beyond a side
        inside,
    };
    /// The place of a box that is given relative to the eye.
    [[nodiscard]] Place place_of(const glm::vec3& middle_m, const glm::vec3& half_m) const;

    /// Not zero where a box is beyond. For loops over many: it has no branches.
    [[nodiscard]] std::uint32_t misses(const glm::vec3& middle_m, const glm::vec3& half_m) const {
        std::uint32_t beyond =
            glm::dot(forward_, middle_m) + glm::dot(forward_reach_, half_m) < 0.0F ? 1U : 0U;
        for (std::size_t side = 0; side < inward_.size(); ++side)
            beyond |= glm::dot(inward_[side], middle_m) + glm::dot(reaches_[side], half_m) < 0.0F
                          ? 1U
                          : 0U;
        return beyond;
    }

    /// The sides that a point lies beyond, as bits; given relative to the eye. What has all its
    /// corners beyond one side cannot be seen.
    [[nodiscard]] std::uint32_t sides_missed_by(const glm::vec3& point_m) const {
        // More than floats may be off in a world of a kilometre.
        constexpr float rounding_m = 1e-3F;
        std::uint32_t sides = 0;
        for (std::uint32_t side = 0; side < inward_.size(); ++side)
            sides |= glm::dot(inward_[side], point_m) < -rounding_m ? 1U << side : 0U;
        return sides;
    }

  private:
    glm::vec3 eye_m_;
    glm::vec3 forward_;
    glm::vec3 forward_reach_;           ///< absolute values: how far a box reaches along it
    std::array<glm::vec3, 4> inward_;   ///< normals of the sides
    std::array<glm::vec3, 4> reaches_;  ///< their absolute values
};

}  // namespace scipd::sim
