// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where so many triangles lie in one place that a ray has to be tested against all of them: a
// search by boxes, as all backends have it, cannot tell apart what lies in the same box. Values;
// any thread. Of 20 million triangles it takes some seconds, of a thousand nothing.
#pragma once

#include <optional>
#include <string>

#include <glm/vec3.hpp>

#include "sim/world/scene.h"

namespace scipd::sim {

struct Overlap {
    double triangles;     ///< that a ray through this place is tested against, on average
    std::string object;   ///< one of those that lie there
    glm::dvec3 middle_m;  ///< of the place, in W
};

/// The worst place that `added` has made in the scene, which holds it already and may be the same;
/// nothing where a ray is tested against no more than `most`. What moves counts by itself alone,
/// since it is elsewhere the next moment.
std::optional<Overlap> worst_overlap(const Scene& scene, const Scene& added, double most);

}  // namespace scipd::sim
