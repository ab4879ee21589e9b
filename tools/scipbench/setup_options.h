// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The options of all commands that start a scipd of their own. One thread.
#pragma once

#include <CLI/CLI.hpp>

#include "tools/scipbench/capacity_site.h"

namespace scipd::tools {

/// --model, --scene and --scipd.
void add_world_and_scanner(CLI::App& command, CapacitySetup& setup);

/// What nobody has said: the rescue maze, and the scipd beside this program. Throws WrongInput
/// where one of them is not there.
void fill_in(CapacitySetup& setup);

}  // namespace scipd::tools
