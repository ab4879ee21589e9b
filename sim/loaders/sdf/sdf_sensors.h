// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The sensors of an SDF document. A scanner does not see them and libsdformat refuses worlds for
// their faults, but each is a place where a scanner could be: it becomes a frame of its model, of
// which the library tells where it is. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/world/lidar.h"

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

struct FoundSensor {
    std::string type;
    std::optional<Lidar> lidar;  ///< where the type is one
};

/// What a frame is marked by that stands for a sensor: its text is the place of the sensor among
/// those that were found.
inline constexpr const char* sensor_mark = "scipd:sensor";
/// Of a sensor that was moved here from elsewhere in its file: the line that it had there.
inline constexpr const char* line_mark = "scipd:line";

/// Adds a frame LINK::SENSOR to the model of each sensor, and the sensor to `found`. The sensors
/// stay. Answers with a warning for each lidar that cannot be offered, which begins with its place
/// in `file`.
std::vector<std::string> offer_sensors(tinyxml2::XMLElement& root,
                                       const std::filesystem::path& file,
                                       std::vector<FoundSensor>& found);

}  // namespace scipd::sim
