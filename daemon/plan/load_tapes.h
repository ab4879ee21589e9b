// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The recordings that a configuration plays in place of a world. Any thread.
#pragma once

#include <map>
#include <stop_token>
#include <string>
#include <vector>

#include "daemon/config/config.h"
#include "daemon/replay/tape.h"

namespace scipd::daemon {

/// By the full names of sensors.
using Tapes = std::map<std::string, SharedTape>;

struct LoadedTapes {
    Tapes tapes;
    std::vector<std::string> warnings;
};

/// Reads them, and makes each sensor whose model is not named the one that its recording is of,
/// with what it said of itself. Throws sim::LoadError with all faults; where the configuration is
/// strict, warnings are faults.
[[nodiscard]] LoadedTapes load_tapes(Config& config, const std::stop_token& stop);

}  // namespace scipd::daemon
