// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads one sensor of a configuration: its keys, and which of them go together. One thread at a
// time.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "daemon/config/claims.h"
#include "daemon/config/models.h"
#include "daemon/config/replay_config.h"
#include "daemon/config/sensor_config.h"
#include "sim/expected.h"
#include "sim/loaders/yaml/yaml_section.h"

namespace scipd::daemon {

/// What is needed to read any sensor of a document.
struct SensorContext {
    const ModelChoice& models;
    Claims& claims;
    std::filesystem::path base;  ///< of relative paths
    sim::YamlFaults& faults;
    std::map<std::string, std::string>& places;  ///< as of Config
    std::string robot = {};                      ///< whose sensors are read
};

/// Refuses what the model cannot power up as, and says what to do.
[[nodiscard]] sim::Expected<> check_power_up(PowerUp power_up,
                                             const protocol::DeviceProfile& profile);

SensorConfig read_sensor(const sim::YamlField& field, SensorContext& context);

/// A file, a list of them, or a map {file, stream, loop, speed, from_s}. Files are relative to
/// `base`.
[[nodiscard]] ReplayConfig read_replay(const sim::YamlField& field,
                                       const std::filesystem::path& base, sim::YamlFaults& faults);

/// A file or folder that is no trajectory by its name.
[[nodiscard]] sim::Expected<std::filesystem::path> parse_recording(
    std::string_view text, const std::filesystem::path& base);

/// true, false, or on: the stamps go on from round to round.
[[nodiscard]] sim::Expected<ReplayLoop> parse_loop(std::string_view text);

}  // namespace scipd::daemon
