// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The space that a strip sees, from an eye in anchored W: which boxes and triangles can be left
// out. Four sides through the eye; nothing behind it counts. Pure.
#pragma once

#include <array>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "sim/backends/depth_projection.h"
#include "sim/world/pose.h"

namespace scipd::sim {

class Frustum {
  public:
    Frustum(const Strip& strip, const Pose& anchored_from_sensor);

    [[nodiscard]] const glm::vec3& eye_m() const { return eye_m_; }

    enum class Place {
        beyond,  ///< nothing of it can be seen
        across,  ///< some of it may lie beyond a side
        inside,
    };
    /// Where a box lies, given relative to the eye.
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
