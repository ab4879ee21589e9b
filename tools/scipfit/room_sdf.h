// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A room as an SDF world. One thread.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tools/scipfit/wall_fit.h"

namespace scipd::tools {

/// The scanner is at the origin, in the middle of the walls' height. `readings`: where they are
/// from.
void write_room(const std::vector<Wall>& walls, const Readings& readings, std::ostream& out);

}  // namespace scipd::tools
