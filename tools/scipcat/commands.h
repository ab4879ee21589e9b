// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <CLI/CLI.hpp>

namespace scipd::tools {

/// `scipcat info TARGET`: what a scanner says of itself.
void add_info_command(CLI::App& program);

/// `scipcat record TARGET -o FILE.csv|FILE.jsonl`: scans into a file.
void add_record_command(CLI::App& program);

/// `scipcat plot TARGET [-o FILE.png|FILE.svg]`: one scan from above.
void add_plot_command(CLI::App& program);

}  // namespace scipd::tools
