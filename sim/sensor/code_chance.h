// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Why a beam without a range has now one code and now another is not known, so chance decides. It
// is drawn here, where the seed is; which codes there are is the model's matter. Pure; any thread.
#pragma once

#include <span>

#include "sim/random.h"
#include "sim/sensor/reading.h"

namespace scipd::sim {

/// For the readings of a scan that have no range; the first is beam 0.
void draw_code_chances(ChanceKey key, std::span<Reading> readings);

}  // namespace scipd::sim
