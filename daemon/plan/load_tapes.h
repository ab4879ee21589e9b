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
#include "daemon/replay/replay.h"

namespace scipd::daemon {

/// By the full names of sensors.
using Tracks = std::map<std::string, Track>;

struct LoadedTapes {
    Tracks tracks;
    std::vector<std::string> warnings;
};

/// Reads them, and makes each sensor whose model is not named the one that its recording is of,
/// with what it said of itself. Sensors that play the same files share a time line. One that
/// `serves_all` becomes a sensor for each scanner of its recording. Throws sim::LoadError with all
/// errors; where the configuration is strict, warnings are errors.
[[nodiscard]] LoadedTapes load_tapes(Config& config, const std::stop_token& stop);

}  // namespace scipd::daemon
