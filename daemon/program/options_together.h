// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which options of the command line go together. At the start, on the only thread.
#pragma once

#include <CLI/CLI.hpp>

#include "sim/expected.h"

namespace scipd::daemon {

/// Refuses options that do not go together. --config goes with those that are of no scanner.
[[nodiscard]] sim::Expected<> check_together(const CLI::App& app);

}  // namespace scipd::daemon
