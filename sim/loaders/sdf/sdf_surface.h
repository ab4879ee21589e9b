// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads what a scanner needs of a <visual> or a <collision>. Any thread; nothing shared.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <tinyxml2.h>

#include "sim/loaders/parts/part.h"
#include "sim/loaders/sdf/sdf_geometry.h"

namespace scipd::sim {

/// Called with a sentence about something that cannot be read and does not count.
using Ignored = std::function<void(const std::string& what)>;

/// Without a name. Throws UnreadableValue if its pose cannot be read.
SdfSurface surface_of(const tinyxml2::XMLElement& element, const SdfSheet& sheet,
                      const Ignored& ignored);

/// Gives a link those of its surfaces that scanners see. Visuals without a laser_retro get that of
/// the collisions, if all that have one agree: Gazebo Classic reads it in the collision, Gazebo Sim
/// in the visual.
void put_surfaces(std::vector<SdfSurface> visuals, std::vector<SdfSurface> collisions,
                  SdfGeometry seen, SdfPart& link);

}  // namespace scipd::sim
