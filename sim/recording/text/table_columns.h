// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the columns of a table are, by the line above them: names such as range_0, range_1, ... or
// ranges[0], as spreadsheets, pandas and `rostopic echo -p` write them, or the angles or steps
// alone. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/expected.h"
#include "sim/recording/values/directions.h"
#include "sim/recording/values/recorded_scan.h"

namespace scipd::sim {

struct TableColumns {
    struct Block {
        std::size_t first = 0;
        std::size_t count = 0;
    };

    std::size_t all = 0;
    Block ranges;
    std::optional<Block> intensities;
    std::optional<std::size_t> host_time;  ///< since 1970
    std::optional<std::size_t> stamp_ms;
    std::optional<std::size_t> first_rad;
    std::optional<std::size_t> increment_rad;
    Directions directions;
    std::optional<RangeUnit> unit;  ///< if a name says it
    std::string headed;             ///< what the ranges stand under, such as "angles in degrees"
    std::vector<std::string> left_out;  ///< the names of the others
};

/// The fault names the cell, and says what to do.
[[nodiscard]] Expected<TableColumns> columns_named(const std::vector<std::string_view>& names);

/// Nothing if these are neither angles nor steps.
[[nodiscard]] std::optional<TableColumns> columns_numbered(const std::vector<double>& numbers);

}  // namespace scipd::sim
