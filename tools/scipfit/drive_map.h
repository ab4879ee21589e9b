// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The floor map of a building that a scanner was carried through, and how well it explains what the
// scanner saw. Values; one thread.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "sim/export/floor_map.h"
#include "tools/scipfit/drive.h"

namespace scipd::tools {

struct DriveMap {
    sim::FloorMap map;
    std::size_t scans = 0;
    std::size_t without_place = 0;  ///< scans that do not say where the scanner was: left out
    std::size_t readings = 0;
    std::size_t explained = 0;  ///< end at a face, or a cell beside one
    double rms_mm = 0.0;        ///< how far those end from it
    /// The places were refined: each scan was laid over what those before it had seen. Else what is
    /// recorded explains as much.
    bool refined = false;
    double most_moved_m = 0.0;  ///< by that
};

/// The first scan's place is the origin, its forward the x axis. Throws WrongInput where the drive
/// takes too many cells, and where nothing was met twice.
[[nodiscard]] DriveMap map_of(const Drive& drive, double cell_m);

[[nodiscard]] nlohmann::ordered_json as_json(const DriveMap& map);
/// Sentences, each on a line of its own.
[[nodiscard]] std::string as_text(const DriveMap& map);

}  // namespace scipd::tools
