// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include "tools/scipcat/sheet.h"
#include "tools/scipcat/top_view.h"

namespace scipd::tools {

void draw_rings(const Sheet& sheet);

/// Writes the distance of each ring, all along one direction: the one where most labels are visible
/// and farthest from everything that was measured.
void draw_ring_labels(const Sheet& sheet, const TopView& view);

}  // namespace scipd::tools
