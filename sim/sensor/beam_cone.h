// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Beams that fill a cone around +x of S evenly: those of an ultrasonic or infrared ranger. A value;
// any thread.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

namespace scipd::sim {

struct BeamCone {
    double opening_rad = 0.0;  ///< all of it, up to pi
    int beams = 0;

    bool operator==(const BeamCone&) const = default;

    /// In S, unit vectors: the first on the axis, the last at the rim, each with as much of the
    /// solid angle as any other.
    [[nodiscard]] std::vector<glm::vec3> directions() const;
};

}  // namespace scipd::sim
