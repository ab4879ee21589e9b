// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// `scipbench capacity` as a user calls it. One thread.
#pragma once

#include <CLI/CLI.hpp>

namespace scipd::tools {

/// Adds the command.
void add_capacity(CLI::App& program);

}  // namespace scipd::tools
