// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <CLI/CLI.hpp>

namespace scipd::tools {

/// `scipfit RECORDING...`: what all of the program does where no command is named.
void add_fit_options(CLI::App& program);

}  // namespace scipd::tools
