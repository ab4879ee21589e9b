// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <CLI/CLI.hpp>

namespace scipd::tools {

/// `scipcat plot TARGET [-o FILE.png|FILE.svg]`: one scan from above.
void add_plot_command(CLI::App& program);

}  // namespace scipd::tools
