// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a running rig has counted. On the I/O thread.
#pragma once

#include "daemon/api/rig_metrics.h"
#include "daemon/rig/stations.h"

namespace scipd::daemon {

struct Simulation;

[[nodiscard]] RigMetrics metrics_of(const Simulation& simulation);

/// Keeps what these have counted for sensors of the same names that come after them. To be called
/// once, before they are gone and before others have their ports; null is passed over.
void keep_counts(const Stations& leaving, Simulation& simulation);

}  // namespace scipd::daemon
