// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Tables: a row a scan, numbers between blanks, tabs, commas or semicolons, as numpy.savetxt and
// spreadsheets write them. A line above them may say what the columns are (table_columns.h);
// without one they say neither where the steps look nor when a scan was made. The unit is guessed
// by all numbers, unless a name says it.
// Logs of CoreSLAM and BreezySLAM are such tables, too: of a URG-04LX, with 24 numbers in front.
// Any thread; nothing shared.
#pragma once

#include <memory>
#include <string_view>

#include "sim/recording/file/input_file.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {

/// Whether a table begins with this line, or this beginning of one.
[[nodiscard]] bool is_row_of_numbers(std::string_view line);

/// Whether the line above a table is like this, or begins like this.
[[nodiscard]] bool names_ranges(std::string_view line);

[[nodiscard]] Expected<std::unique_ptr<Recording>> open_rows(InputFile file);

}  // namespace scipd::sim
