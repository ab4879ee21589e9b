// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/text/table_row.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>

#include "sim/text/text_number.h"

namespace scipd::sim::table {
namespace {

std::string_view without_plus(std::string_view number) {
    return number.starts_with('+') ? number.substr(1) : number;
}

/// Without a plus in front; empty if there is no such cell.
std::string_view cell_at(const Cells& cells, Column column, std::size_t behind = 0) {
    if (!column) return {};
    const std::size_t index =
        static_cast<std::size_t>(*column) + behind + (*column < 0 ? cells.size() : 0);
    return index < cells.size() ? without_plus(cells[index]) : std::string_view{};
}

template <class Whole>
std::optional<Whole> whole_at(const Cells& cells, Column column, double most) {
    const auto value = finite_at(cells, column);
    if (!value || !(*value >= 0 && *value <= most)) return std::nullopt;
    return static_cast<Whole>(*value);
}

std::optional<HostTime> time_at(const Cells& cells, Column column) {
    const std::string_view cell = cell_at(cells, column);
    const auto number = parse_number(cell);
    if (!number) return std::nullopt;
    int power = 0;
    for (double most = 1e11; power > -9 && *number >= most; most *= 1e3)
        power -= 3;
    const auto time = parse_stamp(cell, power);
    return time ? std::optional(HostTime(*time)) : std::nullopt;
}

/// Returns nullopt if one of the three is no number, as where a program did not know the place.
std::optional<LaserPose> pose_at(const Cells& cells, Column column) {
    const auto x_m = finite_at(cells, column);
    const auto y_m = finite_at(cells, column, 1);
    const auto yaw_rad = finite_at(cells, column, 2);
    return x_m && y_m && yaw_rad ? std::optional(LaserPose{*x_m, *y_m, *yaw_rad}) : std::nullopt;
}

}  // namespace

Cells cells_of(std::string_view row, char separator, std::size_t wanted) {
    const auto has = [&](char mark) { return row.find(mark) != row.npos; };
    if (separator == any_separator) separator = has(';') ? ';' : has(',') ? ',' : ' ';
    const std::string_view separators = separator == ' ' ? " \t" : std::string_view(&separator, 1);
    row = trimmed(row);
    const bool ends_empty = row.ends_with(separator);
    Cells cells;
    while (!row.empty()) {
        const std::string_view cell = row.substr(0, row.find_first_of(separators));
        cells.push_back(trimmed(cell));
        row = trimmed(row.substr(std::min(cell.size() + 1, row.size())));
    }
    if (ends_empty && cells.size() + 1 == wanted) cells.emplace_back();
    return cells;
}

bool is_no_row(std::string_view line) {
    line = trimmed(line);
    return line.empty() || line.front() == '#';
}

std::optional<double> number_in(std::string_view cell) {
    if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
    cell = without_plus(cell);
    if (const auto number = parse_number(cell)) return number;
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc{} || end != cell.data() + cell.size()) return std::nullopt;
    return value;
}

std::optional<double> finite_at(const Cells& cells, Column column, std::size_t behind) {
    return parse_number(cell_at(cells, column, behind));
}

tl::expected<RecordedScan, std::size_t> scan_of(const Cells& cells,
                                                const Description& description) {
    constexpr double most_us = 1e15;
    const Columns& columns = description.columns;
    RecordedScan scan = description.blank;
    scan.host_time = time_at(cells, columns.host_time);
    scan.stamp_ms = whole_at<std::uint32_t>(cells, columns.stamp_ms, 0xFFFFFFFF);
    scan.stamp_us = whole_at<std::uint64_t>(cells, columns.stamp_us, most_us);
    scan.pose = pose_at(cells, columns.pose);
    if (const auto first = finite_at(cells, columns.first_rad)) scan.directions.first_rad = first;
    if (const auto step = finite_at(cells, columns.increment_rad))
        scan.directions.increment_rad = step;
    for (std::size_t step = 0; step < description.blocks.front().steps; ++step) {
        for (const Block& block : description.blocks) {
            const std::size_t index = block.first + step * block.stride;
            if (cells[index].empty() && description.echoes) continue;
            const auto number = number_in(cells[index]);
            if (!number) return tl::unexpected(index);
            (block.intensities ? scan.intensities : scan.ranges).push_back(*number);
        }
        if (description.echoes)
            scan.echo_ends.push_back(static_cast<std::uint32_t>(scan.ranges.size()));
    }
    return scan;
}

}  // namespace scipd::sim::table
