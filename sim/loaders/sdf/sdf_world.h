// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What only a world holds: actors, roads and populations of models. Any thread; nothing shared.
#pragma once

#include <string_view>
#include <vector>

#include <glm/vec3.hpp>
#include <tinyxml2.h>

#include "sim/loaders/file/scene_draft.h"
#include "sim/loaders/parts/part.h"
#include "sim/loaders/sdf/sdf_geometry.h"
#include "sim/loaders/sdf/sdf_values.h"

namespace scipd::sim {

/// What an <actor> is beyond a model, for example a person who walks along a script. It is a
/// movable model whose skin is the visual of a link. The draft is told what cannot be read.
Actor actor_of(const tinyxml2::XMLElement& element, const SdfSheet& sheet, SceneDraft& draft);

/// The name of the link that shows the skin, and of its visual.
inline constexpr std::string_view skin_name = "skin";

/// The link that shows the skin of an actor, which it must have.
SdfPart skin_link_of(const Actor& actor, const FilePlace& place);

/// A <road>, a strip along points, as a static model of one visual.
SdfPart road_of(const tinyxml2::XMLElement& road, const SdfSheet& sheet);

/// Where a <population> puts its models in the world, as Gazebo Classic 11 does
/// (gazebo/physics/Population.cc); models do not turn. Where that throws dice, these fall alike in
/// every load. Throws UnreadableValue.
std::vector<glm::dvec3> places_of_population(const tinyxml2::XMLElement& population,
                                             const Dialect& dialect);

}  // namespace scipd::sim
