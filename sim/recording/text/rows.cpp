// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/text/rows.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/recording/text/row_cells.h"
#include "sim/recording/text/table_look.h"
#include "sim/recording/text/text_recording.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

/// As programs write it: the size tells the unit. Nothing where it is none since 1970.
std::optional<HostTime> likely_host_time(double time) {
    struct Unit {
        double least;
        double per_s;
    };
    for (const Unit unit : {Unit{1e17, 1e9}, Unit{1e14, 1e6}, Unit{1e11, 1e3}, Unit{1e8, 1}}) {
        if (!(time >= unit.least && time < 1e4 * unit.least)) continue;
        const double whole_s = std::floor(time / unit.per_s);
        const double rest_s = time / unit.per_s - whole_s;
        return host_time_at(static_cast<std::int64_t>(whole_s), std::llround(rest_s * 1e6) * 1000);
    }
    return std::nullopt;
}

/// A row of CoreSLAM begins with a time in microseconds, the odometry and what else the robot said.
/// Behind the 682 steps of a URG-04LX, from step 44 on, one more number may stand.
struct CoreSlam {
    static constexpr std::size_t in_front = 24;
    static constexpr std::size_t steps = 682;
    static constexpr int first_step = 44;

    static bool has(const std::vector<double>& row) {
        constexpr double no_range = 65536;  // so it is a time
        const auto is_whole = [](double range) { return range == std::floor(range); };
        return row.size() >= in_front + steps && row.size() <= in_front + steps + 1 &&
               row.front() >= no_range && row.front() < 1e15 &&
               std::all_of(row.begin() + in_front, row.end(), is_whole);
    }
    static ScannerIdentity identity() {
        return {.model = "URG-04LX",
                .min_range_m = 0.02,
                .max_range_m = 5.6,
                .steps_per_turn = 1024,
                .front_step = 384};
    }
};

class Rows final : public TextRecording {
  public:
    Rows(InputFile file, TableLook look)
        : TextRecording("rows", std::move(file)), look_(std::move(look)) {
        add_stream({.name = "scanner", .type = "rows of numbers"});
    }

  private:
    Next take(std::string_view line) override {
        line = row_in(line);
        if (is_no_row(line)) return std::nullopt;
        auto cells = cells_of(line);
        if (columns_.all == 0 && look_.header) {
            if (!*look_.header) return tl::unexpected(look_.header->error());
            begin_below(**look_.header);
            return std::nullopt;
        }
        if (columns_.all == 0) {
            if (auto fault = begin(cells)) return refuse(*fault);
        }
        // The last cell is empty, where other rows have no separator behind them.
        if (cells.size() + 1 == columns_.all && (line.ends_with(',') || line.ends_with(';')))
            cells.emplace_back();
        if (cells.size() != columns_.all)
            return refuse("must have " + std::to_string(columns_.all) +
                          " numbers as the first row, not " + std::to_string(cells.size()));
        if (core_slam_) return item_of(scan_of_core_slam(cells));
        return item_of(scan_of(cells));
    }

    static Next item_of(Expected<RecordedScan> scan) {
        if (!scan) return tl::unexpected(scan.error());
        return RecordedItem{0, *std::move(scan)};
    }

    void begin_below(const TableColumns& columns) {
        columns_ = columns;
        stream(0).type += " under " + columns_.headed;
        tell_unit();
        if (columns_.left_out.empty()) return;
        std::string names = quote(columns_.left_out.front());
        if (columns_.left_out.size() > 1)
            names += " and " + std::to_string(columns_.left_out.size() - 1) + " more";
        warn(lines().name() + ": these columns are left out: " + names);
    }

    /// What the first row tells, or why it is no scan.
    std::optional<std::string> begin(const std::vector<std::string_view>& cells) {
        columns_.all = cells.size();
        columns_.ranges = {0, cells.size()};
        const auto numbers = numbers_in(cells, columns_.ranges);
        if (!numbers) return numbers.error().why;
        core_slam_ = CoreSlam::has(*numbers);
        if (core_slam_) {
            stream(0).type = "CoreSLAM";
            stream(0).identity = CoreSlam::identity();
            return std::nullopt;
        }
        tell_unit();
        // The largest that SCIP can send is 262 143.
        constexpr double no_range = 1e6;
        for (std::size_t column = 0; column < cells.size(); ++column) {
            const double number = (*numbers)[column];
            if (std::isfinite(number) && std::abs(number) >= no_range)
                return name_of_cell(cells, column) +
                       " is no range; leave out the columns that are none, such as times: cut "
                       "-d, -f2-";
        }
        return std::nullopt;
    }

    /// Says that it is a guess where it is one.
    void tell_unit() {
        if (columns_.unit) return;
        stream(0).type +=
            look_.unit == RangeUnit::metres ? ", taken for metres" : ", taken for millimetres";
    }

    static std::string name_of_cell(const std::vector<std::string_view>& cells,
                                    std::size_t column) {
        return "column " + std::to_string(column + 1) + ": " + quote(cells[column]);
    }

    static Expected<std::vector<double>> numbers_in(const std::vector<std::string_view>& cells,
                                                    TableColumns::Block block) {
        std::vector<double> numbers;
        for (std::size_t column = block.first; column < block.first + block.count; ++column) {
            const auto number = number_in(cells[column]);
            if (!number) {
                const bool comma = cells[column].find(',') != std::string_view::npos;
                return sim::refuse(name_of_cell(cells, column) + " is no number" +
                                   (comma ? "; write decimal points" : ""));
            }
            numbers.push_back(*number);
        }
        return numbers;
    }

    Expected<RecordedScan> scan_of(const std::vector<std::string_view>& cells) const {
        RecordedScan scan;
        scan.unit = look_.unit;
        auto ranges = numbers_in(cells, columns_.ranges);
        if (!ranges) return tl::unexpected(ranges.error());
        scan.ranges = *std::move(ranges);
        if (columns_.intensities) {
            auto intensities = numbers_in(cells, *columns_.intensities);
            if (!intensities) return tl::unexpected(intensities.error());
            scan.intensities = *std::move(intensities);
        }
        const auto value = [&](const std::optional<std::size_t>& column) {
            return column ? number_in(cells[*column]) : std::nullopt;
        };
        if (const auto time = value(columns_.host_time)) scan.host_time = likely_host_time(*time);
        if (const auto stamp = value(columns_.stamp_ms); stamp && *stamp >= 0 && *stamp < 1U << 24)
            scan.stamp_ms = static_cast<std::uint32_t>(*stamp);
        scan.directions = columns_.directions;
        if (const auto first = value(columns_.first_rad)) scan.directions.first_rad = first;
        if (const auto step = value(columns_.increment_rad)) scan.directions.increment_rad = step;
        return scan;
    }

    [[nodiscard]] Expected<RecordedScan> scan_of_core_slam(
        const std::vector<std::string_view>& cells) {
        const auto row = numbers_in(cells, columns_.ranges);
        if (!row) return tl::unexpected(row.error());
        RecordedScan scan;
        scan.stamp_us = static_cast<std::uint64_t>(std::max(0.0, row->front()));
        scan.directions = with_angles({.first_step = CoreSlam::first_step}, stream(0).identity);
        const auto begin = row->begin() + CoreSlam::in_front;
        scan.ranges.assign(begin, begin + CoreSlam::steps);
        return scan;
    }

    TableLook look_;
    TableColumns columns_;  ///< none before the first row
    bool core_slam_ = false;
};

}  // namespace

bool is_row_of_numbers(std::string_view line) {
    line = row_in(line);
    // Where the commas are in the numbers, it is a table as well, and refused as one.
    constexpr std::string_view letters = "0123456789+-.,; \tenaif";
    constexpr std::string_view digits = "0123456789";
    const auto is_of_numbers = [&](char c) {
        return letters.find(static_cast<char>(std::tolower(static_cast<unsigned char>(c)))) !=
               letters.npos;
    };
    return line.find_first_of(digits) != line.npos && line.find_first_of(" \t,;") != line.npos &&
           std::ranges::all_of(line, is_of_numbers);
}

bool names_ranges(std::string_view line) {
    return columns_named(cells_of(row_in(line))).has_value();
}

Expected<std::unique_ptr<Recording>> open_rows(InputFile file) {
    const auto beginning = file.read(0, LineFile::longest_line);
    if (!beginning) return tl::unexpected(beginning.error());
    return std::make_unique<Rows>(std::move(file), look_at_table(*beginning));
}

}  // namespace scipd::sim
