// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where the walls of a room end: at corners, at edges, and behind what stands before them. Pure;
// any thread.
#pragma once

#include <vector>

#include "tools/analysis/scan_table.h"
#include "tools/scipfit/standing.h"
#include "tools/scipfit/wall.h"

namespace scipd::tools {

/// Finds `begin` and `end` of each from its beams, and leaves out what is only a corner of two
/// others. They are in the order of their beams.
void find_ends(std::vector<Wall>& walls, const ScanTable& readings, const std::vector<Beam>& beams);

}  // namespace scipd::tools
