// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Looks at a running rig. On the I/O thread, while its shards stand still.
#pragma once

#include "daemon/api/rig_report.h"
#include "daemon/rig/stations.h"

namespace scipd::daemon {

struct Simulation;

[[nodiscard]] RigReport report_of(const Simulation& simulation);

/// Keeps what these have counted for sensors of the same names that come after them. To be called
/// once, before they are gone and before others have their ports.
void keep_counts(const Stations& leaving, Simulation& simulation);

}  // namespace scipd::daemon
