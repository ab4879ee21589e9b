// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// An <actor> is, for example, a person who walks along a script. It is a movable model whose skin
// is the visual of a link. Any thread; nothing shared.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <tinyxml2.h>

#include "sim/loaders/parts/part.h"
#include "sim/loaders/sdf/sdf_geometry.h"

namespace scipd::sim {

/// The name of the link that shows the skin, and of its visual.
inline constexpr std::string_view skin_name = "skin";

/// What an <actor> is beyond a model. Each warning begins with its place.
Actor actor_of(const tinyxml2::XMLElement& element, const SdfSheet& sheet,
               std::vector<std::string>& warnings);

/// The link that shows its skin, which it must have.
SdfPart skin_link_of(const Actor& actor, const FilePlace& place);

}  // namespace scipd::sim
