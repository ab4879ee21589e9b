// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <CLI/CLI.hpp>

namespace scipd::tools {

/// `scipcat info TARGET`: shows what a scanner reports about itself, or what a recording holds.
void add_info_command(CLI::App& program);

/// `scipcat record TARGET -o FILE.mcap|FILE.ubh|FILE.csv|FILE.jsonl`: writes scans to a file.
void add_record_command(CLI::App& program);

/// `scipcat info RECORDING`: prints what it holds, for people or as JSON. Throws WrongInput if it
/// cannot be read.
void show_recording(const std::string& target, bool json);

/// `scipcat plot TARGET [-o FILE.png|FILE.svg]`: draws one scan from above.
void add_plot_command(CLI::App& program);

/// `scipcat compare A B`: tells how the scans of two scanners or recordings differ.
void add_compare_command(CLI::App& program);

/// `scipcat check TARGET`: holds a scanner to a numbered list of what SCIP promises.
void add_check_command(CLI::App& program);

/// `scipcat proxy TARGET --listen ADDR:PORT|--pty LINK`: stands between a driver and a scanner.
void add_proxy_command(CLI::App& program);

/// `scipcat twin TARGET -o DIR/`: makes of a scanner one that scipd runs, where it stands.
void add_twin_command(CLI::App& program);

}  // namespace scipd::tools
