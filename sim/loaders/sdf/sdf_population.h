// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where the <population> of a world puts its models, as Gazebo Classic 11 does
// (gazebo/physics/Population.cc). Where that throws dice, these fall alike in every load. Any
// thread; nothing shared.
#pragma once

#include <vector>

#include <glm/vec3.hpp>
#include <tinyxml2.h>

#include "sim/loaders/sdf/sdf_values.h"

namespace scipd::sim {

/// In the world; models do not turn. Throws UnreadableValue.
std::vector<glm::dvec3> places_of_population(const tinyxml2::XMLElement& population,
                                             const Dialect& dialect);

}  // namespace scipd::sim
