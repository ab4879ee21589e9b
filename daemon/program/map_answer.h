// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// `scipd --map`: a ROS map of the world that would be scanned, without scanning it. One thread.
#pragma once

#include <filesystem>
#include <optional>

#include "daemon/config/config.h"
#include "daemon/program/answers.h"
#include "sim/export/map_values.h"

namespace scipd::daemon {

struct MapRequest {
    std::filesystem::path file;  ///< empty: nobody asks for a map
    std::optional<sim::HeightBand> heights;
    std::optional<double> resolution_m;
};

/// Writes the map of the configuration's world at load, without the bodies of its robots; what can
/// be reached from where they start is free. Throws LoadError.
Answer write_map(const Config& config, const MapRequest& request);

}  // namespace scipd::daemon
