// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A <road> of a world: a strip along points. Any thread; nothing shared.
#pragma once

#include <tinyxml2.h>

#include "sim/loaders/parts/part.h"
#include "sim/loaders/sdf/sdf_geometry.h"

namespace scipd::sim {

/// The road as a static model of one visual.
SdfPart road_of(const tinyxml2::XMLElement& road, const SdfSheet& sheet);

}  // namespace scipd::sim
