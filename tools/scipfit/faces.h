// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where the faces end that the beams of a standing scanner see. Pure; any thread.
#pragma once

#include <vector>

#include "tools/scipfit/beam.h"

namespace scipd::tools {

/// Says of each beam whether a face ends before it and whether it is inside one, and how that
/// slopes. Their middles and their stillness are known.
void find_faces(double beam_rad, std::vector<Beam>& beams);

}  // namespace scipd::tools
