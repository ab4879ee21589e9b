// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Follows light that does not end where it first meets something: it goes straight on through
// glass, and back from mirrors. Refraction is left out: a pane shifts what is behind it by less
// than its thickness. Lives on the thread of the backend.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/backends/range_backend.h"
#include "sim/sensor/scan.h"
#include "sim/world/lit_world.h"

namespace scipd::sim {

/// How many faces a ray may pass or be mirrored by.
inline constexpr int most_faces_passed = 6;

/// Appends what the rays of a fan meet after their first hit, by growing ray. The backend follows
/// light. `first_ray` is added to the fan's own indices.
void follow_light(RangeBackend& backend, const Fan& fan, const LitWorld& lit,
                  std::uint32_t first_ray, std::span<const Hit> hits,
                  std::span<const glm::vec3> world_normals, std::vector<FartherHit>& farther);

}  // namespace scipd::sim
