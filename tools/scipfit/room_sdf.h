// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A room as an SDF world. One thread.
#pragma once

#include <iosfwd>

#include "tools/scipfit/kind.h"
#include "tools/scipfit/room_fit.h"

namespace scipd::tools {

/// The scanner is at the origin, in the middle of the walls' height. `readings`: where they are
/// from; `model`: how its receiver tells what is brighter than white.
void write_room(const Room& room, const ScanTable& readings, const daemon::Model& model,
                std::ostream& out);

}  // namespace scipd::tools
