// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// `scipbench capacity` and `scipbench lockstep` as a user calls them: they start a scipd of their
// own. One thread.
#pragma once

#include <CLI/CLI.hpp>

#include "tools/scipbench/capacity_site.h"

namespace scipd::tools {

/// Each adds its command.
void add_capacity(CLI::App& program);
void add_lockstep(CLI::App& program);

}  // namespace scipd::tools
