// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <CLI/CLI.hpp>

namespace scipd::tools {

/// `scipcat info TARGET`: what a scanner says of itself.
void add_info_command(CLI::App& program);

}  // namespace scipd::tools
