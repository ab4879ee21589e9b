// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scan that is finished and goes to whoever wants it. Any thread.
#pragma once

#include "sim/sensor/scan.h"

namespace scipd::sim {

/// Once nobody has it any more, the next scans use its arrays (Recycled).
[[nodiscard]] SharedScan share(Scan scan);

}  // namespace scipd::sim
