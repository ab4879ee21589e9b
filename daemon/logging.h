// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where logs go and what their lines look like. Once, before anything logs.
#pragma once

#include <string>

namespace scipd::daemon {

/// Logs go to standard error, each line beginning with the time and the level; standard output
/// belongs to the ready line. `level` is one of spdlog's names; throws std::invalid_argument for
/// another.
void start_logging(const std::string& level);

}  // namespace scipd::daemon
