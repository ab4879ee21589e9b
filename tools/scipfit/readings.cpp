// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/readings.h"

namespace scipd::tools {

void apply_limits(double nearest_mm, double farthest_mm, Readings& readings) {
    const auto nearest = static_cast<float>(nearest_mm);
    const auto farthest = static_cast<float>(farthest_mm);
    for (float& mm : readings.mm) {
        if (!is_distance(mm) || (mm >= nearest && mm <= farthest)) continue;
        mm = readings.has_codes ? as_code(mm) : no_value;
    }
}

}  // namespace scipd::tools
