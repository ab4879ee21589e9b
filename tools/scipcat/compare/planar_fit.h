// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where B stands, seen from A, if both look at one place: the small motion in the plane that brings
// B's points onto A's lines. What does not fit, since it was moved, has no say in it. Functions of
// numbers; any thread.
#pragma once

#include <optional>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include "tools/scipcat/compare/outline.h"

namespace scipd::tools::comparing {

/// From B's frame to A's.
struct PlanarMotion {
    glm::dvec2 shift_mm{};
    double turn_rad = 0;

    [[nodiscard]] glm::dvec2 operator()(glm::dvec2 point_mm) const;
    /// From A's frame to B's.
    [[nodiscard]] glm::dvec2 back(glm::dvec2 point_mm) const;
    [[nodiscard]] WallLine operator()(const WallLine& line) const;

    bool operator==(const PlanarMotion&) const = default;
};

struct FittedMotion {
    PlanarMotion motion;
    glm::dmat3 covariance{0.0};  ///< of forward, left (in millimetres) and the turn
};

/// None where the scanners have too little in common. B may read all ranges too far or too near:
/// where the place tells that from a motion, it is none. What may be chance is no motion either.
[[nodiscard]] std::optional<FittedMotion> fit_motion(const Outline& a, const Outline& b);

}  // namespace scipd::tools::comparing
