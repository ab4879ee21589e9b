// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/text/csv_columns.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "sim/recording/text/text_values.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

/// One has the host's time, one the scanner's.
constexpr std::size_t time_columns = 2;

struct ColumnName {
    bool intensity = false;
    std::size_t echo = 0;
    bool has_echo = false;  ///< the name has the number of an echo
    int step = 0;
};

bool take(std::string_view& text, std::string_view word) {
    if (!text.starts_with(word)) return false;
    text.remove_prefix(word.size());
    return true;
}

/// "distance_mm_44", "distance2_mm_44" and so on.
std::optional<ColumnName> parse_name(std::string_view text) {
    ColumnName name;
    name.intensity = take(text, "intensity");
    if (!name.intensity && !take(text, "distance")) return std::nullopt;
    name.has_echo = !text.empty() && text.front() >= '1' && text.front() <= '9';
    if (name.has_echo) name.echo = static_cast<std::size_t>(text.front() - '1');
    if (name.has_echo) text.remove_prefix(1);
    if (!take(text, name.intensity ? "_" : "_mm_")) return std::nullopt;
    const auto step = parse_number(text);
    if (!step || *step < 0 || *step > 1e6) return std::nullopt;
    name.step = static_cast<int>(*step);
    return name;
}

}  // namespace

std::vector<std::string_view> csv_cells(std::string_view row) {
    std::vector<std::string_view> cells;
    for (;;) {
        const std::size_t comma = row.find(',');
        cells.push_back(trimmed(row.substr(0, comma)));
        if (comma == row.npos) return cells;
        row.remove_prefix(comma + 1);
    }
}

Expected<CsvColumns> CsvColumns::in(std::string_view header) {
    const auto names = csv_cells(header);
    if (names.size() <= time_columns || names[0] != "host_time_s" || names[1] != "stamp_ms")
        return refuse("the columns must be host_time_s, stamp_ms, distance_mm_S and so on");
    CsvColumns columns;
    for (std::size_t i = time_columns; i < names.size(); ++i) {
        if (const auto added = columns.add(names[i], i); !added)
            return tl::unexpected(added.error());
    }
    columns.columns_ = names.size();
    const std::size_t steps = columns.steps_.size();
    if (columns.blocks_.size() * steps + time_columns != names.size())
        return refuse("each range and intensity must have a column for each step");
    columns.first_step_ = columns.steps_.front();
    if (steps > 1) columns.cluster_ = std::max(columns.steps_[1] - columns.steps_[0], 1);
    return columns;
}

Expected<> CsvColumns::add(std::string_view text, std::size_t column) {
    const auto name = parse_name(text);
    if (!name) return refuse(quote(text) + " is neither distance_mm_S nor intensity_S");
    if (blocks_.empty() || blocks_.back().echo != name->echo ||
        blocks_.back().intensity != name->intensity)
        blocks_.push_back({column, name->echo, name->intensity});
    has_echoes_ = has_echoes_ || name->has_echo;
    if (blocks_.size() == 1) steps_.push_back(name->step);
    if (blocks_.front().intensity) return refuse("the distances must come first");
    return {};
}

Expected<RecordedScan> CsvColumns::scan_of(std::string_view row) const {
    const auto cells = csv_cells(row);
    if (cells.size() != columns_)
        return refuse("there are " + std::to_string(cells.size()) + " cells in place of " +
                      std::to_string(columns_));
    RecordedScan scan;
    scan.host_time = host_time_in(cells[0]);
    const auto stamp = parse_number(cells[1]);
    if (!scan.host_time) return refuse("host_time_s must be a number, not " + quote(cells[0]));
    if (!stamp || *stamp < 0 || *stamp > 0xFFFFFFFF)
        return refuse("stamp_ms must be a number of milliseconds, not " + quote(cells[1]));
    scan.stamp_ms = static_cast<std::uint32_t>(*stamp);
    for (std::size_t step = 0; step < steps_.size(); ++step) {
        for (const Block& block : blocks_) {
            const std::string_view cell = cells[block.first_column + step];
            if (cell.empty() && has_echoes_) continue;
            const auto number = parse_number(cell);
            if (!number)
                return refuse("column " + std::to_string(block.first_column + step + 1) +
                              " must be a number, not " + quote(cell));
            (block.intensity ? scan.intensities : scan.ranges).push_back(*number);
        }
        if (has_echoes_) scan.echo_ends.push_back(static_cast<std::uint32_t>(scan.ranges.size()));
    }
    if (!scan.intensities.empty() && scan.intensities.size() != scan.ranges.size())
        return refuse("there must be an intensity for each distance");
    return scan;
}

}  // namespace scipd::sim
