// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads a URDF robot as a model of links, with all joints at zero. A scanner sees shapes whatever
// they weigh, so links need no inertia. Any thread; nothing shared.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <tinyxml2.h>

#include "sim/loaders/file/scene_draft.h"
#include "sim/loaders/parts/part.h"
#include "sim/loaders/sdf/sdf_geometry.h"
#include "sim/loaders/sdf/sdf_options.h"

namespace scipd::sim {

/// The links of a robot, the materials and the laser_retro of its <gazebo> extensions. The draft is
/// told what cannot be read: joints that make no tree go, and their links stand at the origin.
SdfPart robot_of(const tinyxml2::XMLElement& robot, const SdfSheet& sheet, SdfGeometry geometry,
                 SceneDraft& draft);

/// The <sensor>s in <gazebo reference='LINK'>, each with its link.
std::vector<std::pair<std::string, const tinyxml2::XMLElement*>> sensors_of_robot(
    const tinyxml2::XMLElement& robot);

}  // namespace scipd::sim
