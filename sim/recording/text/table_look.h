// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the beginning of a table tells of all of it: whether a line above says what the columns
// are, and which unit the ranges have. Any thread; nothing shared.
#pragma once

#include <optional>
#include <string_view>

#include "sim/recording/text/table_columns.h"
#include "sim/recording/values/recorded_scan.h"

namespace scipd::sim {

struct TableLook {
    /// Nothing where the first line is a row like the others.
    std::optional<Expected<TableColumns>> header;
    RangeUnit unit = RangeUnit::millimetres;
};

/// `beginning` may be all of it. What is wrong in it is left to whoever reads it.
[[nodiscard]] TableLook look_at_table(std::string_view beginning);

}  // namespace scipd::sim
