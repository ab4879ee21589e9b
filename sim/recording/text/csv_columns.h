// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The columns of a CSV of scans, from the last comment before its rows. A value; any thread.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "sim/expected.h"
#include "sim/recording/values/recorded_scan.h"

namespace scipd::sim {

/// The cells of a row, as they stand between commas.
[[nodiscard]] std::vector<std::string_view> csv_cells(std::string_view row);

class CsvColumns {
  public:
    /// Takes a comment without its mark: "host_time_s,stamp_ms,distance_mm_44,...".
    [[nodiscard]] static Expected<CsvColumns> in(std::string_view header);

    /// The scan of a row, without directions; the fault names the column.
    [[nodiscard]] Expected<RecordedScan> scan_of(std::string_view row) const;

    [[nodiscard]] int first_step() const { return first_step_; }
    /// Nothing where there is a single column.
    [[nodiscard]] std::optional<int> cluster() const { return cluster_; }

  private:
    /// The columns of all steps for the ranges or the intensities of one echo.
    struct Block {
        std::size_t first_column = 0;
        std::size_t echo = 0;
        bool intensity = false;
    };

    [[nodiscard]] Expected<> add(std::string_view name, std::size_t column);

    std::vector<Block> blocks_;
    std::vector<int> steps_;  ///< of the columns of the first block
    std::size_t columns_ = 0;
    bool has_echoes_ = false;
    int first_step_ = 0;
    std::optional<int> cluster_;
};

}  // namespace scipd::sim
