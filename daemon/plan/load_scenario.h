// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Loads what is to go wrong at the scanners of a configuration. Touches nothing that runs: any
// thread may do it.
#pragma once

#include <optional>

#include "daemon/config/config.h"
#include "daemon/faults/scenario.h"

namespace scipd::daemon {

/// Nothing where the configuration names none. Throws sim::LoadError with every fault.
std::optional<Scenario> load_scenario(const Config& config);

}  // namespace scipd::daemon
