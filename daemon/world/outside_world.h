// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Places that lie outside the world, most likely because somebody gave millimetres for metres. Any
// thread; nothing shared.
#pragma once

#include <optional>
#include <string>

#include <glm/vec3.hpp>

#include "sim/world/bounds.h"

namespace scipd::daemon {

/// By more than 10 m, within which robots may start on purpose. `world` is not empty.
bool outside(const sim::Bounds& world, const glm::dvec3& point_m);
/// Whether it lies outside as seen from above: what flies may be far over the world.
bool beside(const sim::Bounds& world, const glm::dvec3& point_m);

/// A warning for a place beside the world, a thousandth of which would not be.
std::optional<std::string> millimetres_beside(const sim::Bounds& world, const glm::dvec3& xyz_m);

}  // namespace scipd::daemon
