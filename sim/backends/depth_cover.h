// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which strips cover a set of directions, and where in them each direction falls. A planar scanner
// gets strips of one row, a camera whose grid is a pinhole's a pixel for each of its own,
// everything else pictures as fine as its directions are dense. Pure; knows no OpenGL.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "sim/backends/depth_options.h"
#include "sim/backends/depth_projection.h"

namespace scipd::sim {

struct Sample {
    std::uint32_t ray = 0;  ///< index into the directions
    glm::dvec2 pixel{0.0};  ///< between the centres of the first and the last pixel of the strip
};

struct StripView {
    Strip strip;
    std::vector<Sample> samples;
};

/// Every direction is in exactly one view. Directions are unit vectors in S.
std::vector<StripView> cover(std::span<const glm::vec3> directions, const DepthOptions& options);

/// The unit normal, upward, of a plane through the eye that holds all directions, if there is one.
std::optional<glm::dvec3> normal_of_common_plane(std::span<const glm::vec3> directions);

/// Passes of one row each over directions that lie in the plane with this normal.
std::vector<StripView> cover_plane(std::span<const glm::vec3> directions, const glm::dvec3& up,
                                   const DepthOptions& options);

/// Pictures over directions that lie anyhow.
std::vector<StripView> cover_solid(std::span<const glm::vec3> directions,
                                   const DepthOptions& options);

/// A view through a strip of the directions with these indices, all of them before it.
StripView view_through(const Strip& strip, std::span<const glm::vec3> directions,
                       std::span<const std::uint32_t> rays);

/// A unit vector at right angles to the direction, level where one is.
glm::dvec3 level_normal_to(const glm::dvec3& direction);

}  // namespace scipd::sim
