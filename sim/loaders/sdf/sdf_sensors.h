// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads the <sensor> of a link. A scanner does not see it, but it is a place to mount one. Any
// thread; nothing shared.
#pragma once

#include <tinyxml2.h>

#include "sim/expected.h"
#include "sim/loaders/parts/part.h"
#include "sim/loaders/sdf/sdf_geometry.h"

namespace scipd::sim {

/// The end of a warning about a lidar.
inline constexpr const char* no_scanner_there =
    "; no scanner can be mounted there, but no range depends on it";

[[nodiscard]] bool is_lidar(const tinyxml2::XMLElement& sensor);

/// The frame LINK::SENSOR that the sensor stands for, or why nothing can be mounted there.
Expected<SdfPart> frame_of_sensor(const tinyxml2::XMLElement& sensor, const std::string& link,
                                  const SdfSheet& sheet);

}  // namespace scipd::sim
