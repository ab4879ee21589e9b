// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The key `fleet` of a configuration: which world this daemon shares with others, and by which
// broker. Any thread; nothing shared.
#pragma once

#include <filesystem>

#include "daemon/config/config.h"
#include "sim/loaders/yaml/yaml_section.h"

namespace scipd::daemon {

void read_fleet(const sim::YamlField& field, const std::filesystem::path& base, Config& config,
                sim::YamlFaults& faults);

}  // namespace scipd::daemon
