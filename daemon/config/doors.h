// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Who may come in by the doors of the control API, and which files they may name: the keys `http`,
// `control` and `allow` of a configuration. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "daemon/config/config.h"
#include "sim/expected.h"
#include "sim/loaders/yaml/yaml_section.h"

namespace scipd::daemon {

/// ADDRESS:PORT, none, or {listen, token_file}. What other machines reach needs a token.
void read_http(const sim::YamlField& field, const std::filesystem::path& base, Config& config,
               sim::YamlFaults& faults);

/// A path, or {socket, group}.
void read_control(const sim::YamlField& field, const std::filesystem::path& base, Config& config,
                  sim::YamlFaults& faults);

/// A list of folders.
void read_allow(const sim::YamlField& field, const std::filesystem::path& base, Config& config,
                sim::YamlFaults& faults);

/// ADDRESS:PORT of loopback, or nothing for `none`: where nobody can say a token.
sim::Expected<std::optional<Address>> parse_http(std::string_view text);

}  // namespace scipd::daemon
