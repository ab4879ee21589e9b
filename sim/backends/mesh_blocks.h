// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A mesh as the depth backend draws it: in blocks of some tens of neighbouring triangles, so that a
// picture can leave most of a large one out, and each triangle begins with a corner that no other
// of its block begins with, so that this corner can carry its number. Pure.
#pragma once

#include <vector>

#include "sim/world/shape.h"

namespace scipd::sim {

/// All but the last are of 64 triangles. Corners that blocks share are doubled.
std::vector<Mesh> in_blocks(Mesh mesh);

}  // namespace scipd::sim
