// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads a configuration from a YAML file. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "daemon/config/config.h"
#include "sim/loaders/file/load_error.h"

namespace scipd::daemon {

/// The keys at the root of a configuration.
std::span<const std::string_view> configuration_keys();

/// Throws sim::LoadError with every fault. Paths in the file are relative to it; in the result they
/// are absolute.
Config load_config(const std::filesystem::path& file);

/// Reads a text as load_config() does a file. `file` names it in faults, and paths in the text are
/// relative to it.
Config parse_config(const std::string& text, const std::filesystem::path& file);

}  // namespace scipd::daemon
