// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The sensors of an SDF document. A scanner does not see them, and libsdformat refuses worlds for
// faults in them. But each is a place to mount a scanner, so it becomes a frame of its model, and
// the library resolves the pose of that frame. Any thread; nothing shared.
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
    std::optional<Lidar> lidar;  ///< if it is a lidar
};

/// The element that marks a frame as a sensor. Its text is the index of the sensor in `found`.
inline constexpr const char* sensor_mark = "scipd:sensor";
/// The attribute of a sensor that was moved from another place in its file: the line that it had
/// there.
inline constexpr const char* line_mark = "scipd:line";

/// Adds a frame LINK::SENSOR to the model of each sensor, and the sensor to `found`. The sensors
/// stay in the document. Returns a warning for each lidar where no scanner can be mounted, which
/// begins with its place in `file`.
std::vector<std::string> offer_sensors(tinyxml2::XMLElement& root,
                                       const std::filesystem::path& file,
                                       std::vector<FoundSensor>& found);

}  // namespace scipd::sim
