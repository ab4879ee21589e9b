// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads a configuration from a YAML file. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>

#include "daemon/config/config.h"
#include "daemon/config/config_error.h"

namespace scipd::daemon {

/// Throws ConfigError with every fault. Paths in the file are relative to it; in the result they
/// are absolute.
Config load_config(const std::filesystem::path& file);

/// The same from text. `file` names it in faults, and paths in the text are relative to it.
Config parse_config(const std::string& text, const std::filesystem::path& file);

}  // namespace scipd::daemon
