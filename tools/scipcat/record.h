// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <CLI/CLI.hpp>

namespace scipd::tools {

/// `scipcat record TARGET -o FILE.csv|FILE.jsonl`: scans into a file.
void add_record_command(CLI::App& program);

}  // namespace scipd::tools
