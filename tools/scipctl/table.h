// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace scipd::tools {

using Row = std::vector<std::string>;

/// Makes columns as wide as their widest cell, two blanks apart. All rows must have the same number
/// of cells.
void print_table(std::ostream& out, std::vector<Row> rows);

}  // namespace scipd::tools
