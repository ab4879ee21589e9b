// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads the key `replay` of a sensor: a recording in place of a world. Any thread.
#pragma once

#include <filesystem>

#include "daemon/config/replay_config.h"
#include "sim/loaders/yaml/yaml_section.h"

namespace scipd::daemon {

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
