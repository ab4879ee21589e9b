// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/text/table_columns.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "sim/recording/text/column_title.h"
#include "sim/recording/text/row_cells.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

constexpr std::size_t fewest_ranges = 3;
constexpr double turn_rad = 2 * std::numbers::pi;

struct Spacing {
    double first = 0;
    double step = 0;
    std::size_t count = 0;

    [[nodiscard]] double last() const { return first + step * static_cast<double>(count - 1); }
    [[nodiscard]] double span() const { return std::abs(last() - first); }
    [[nodiscard]] double farthest() const { return std::max(std::abs(first), std::abs(last())); }
    [[nodiscard]] bool whole() const {
        return first == std::floor(first) && step == std::floor(step);
    }
};

/// How numbers go up or down if they do so evenly; rounded ones are a little off.
std::optional<Spacing> spacing_of(std::span<const double> numbers) {
    constexpr double rounded = 0.25;
    if (numbers.size() < fewest_ranges) return std::nullopt;
    const auto steps = static_cast<double>(numbers.size() - 1);
    const Spacing even{numbers.front(), (numbers.back() - numbers.front()) / steps, numbers.size()};
    if (!std::isfinite(even.step) || even.step == 0) return std::nullopt;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double place = even.first + even.step * static_cast<double>(i);
        if (!(std::abs(numbers[i] - place) <= rounded * std::abs(even.step))) return std::nullopt;
    }
    return even;
}

bool counts_steps(const Spacing& even) {
    constexpr double most_steps = 1e5;
    return even.whole() && even.step > 0 && even.first >= 0 && even.last() < most_steps;
}

void look_to_angles(TableColumns& columns, const Spacing& even, bool degrees) {
    const double unit_rad = degrees ? std::numbers::pi / 180 : 1;
    columns.directions.first_rad = even.first * unit_rad;
    columns.directions.increment_rad = even.step * unit_rad;
    columns.headed = degrees ? "angles in degrees" : "angles in radians";
}

/// Whole numbers from 0 on are steps unless a name says otherwise, and angles that fit into one
/// turn of radians are radians. Nothing where the numbers are neither.
bool tell_directions(TableColumns& columns, const Spacing& even, const ColumnTitle& name) {
    const bool angles = name.has("angle") || name.has_word("deg") || name.has_word("rad");
    if (!angles && counts_steps(even)) {
        columns.directions.first_step = static_cast<int>(even.first);
        columns.directions.cluster = static_cast<int>(even.step);
        columns.headed = "numbers of steps";
        return true;
    }
    const auto fits = [&](double turn) {
        const double most = turn + std::abs(even.step);
        return even.span() <= most && even.farthest() <= most;
    };
    const bool degrees =
        name.has_word("deg") || (!name.has_word("rad") && (even.whole() || !fits(turn_rad)));
    if (!fits(degrees ? 360 : turn_rad)) return false;
    look_to_angles(columns, even, degrees);
    return true;
}

/// Columns beside each other whose names are the same but for numbers that go up or down evenly.
struct NamedBlock {
    TableColumns::Block block;
    ColumnTitle name;
    Spacing even;

    [[nodiscard]] bool is_of_intensities() const {
        return name.has("intensit") || name.has("remission") || name.has("rssi") ||
               name.has("reflect");
    }
    [[nodiscard]] bool is_of_ranges() const { return name.has("rang") || name.has("dist"); }
};

/// "range-1" beside "range1" is of an angle below 0: the dash is a minus.
void take_dashes_for_minuses(std::vector<ColumnTitle>& names) {
    std::set<std::string> stems;
    for (const ColumnTitle& name : names) {
        if (name.number) stems.insert(name.stem);
    }
    for (ColumnTitle& name : names) {
        if (!name.number || !name.stem.ends_with('-')) continue;
        const std::string stem = name.stem.substr(0, name.stem.size() - 1);
        if (stems.contains(stem)) name = {stem, -*name.number};
    }
}

std::vector<NamedBlock> blocks_of(const std::vector<ColumnTitle>& names) {
    std::vector<NamedBlock> blocks;
    for (std::size_t first = 0; first < names.size();) {
        std::vector<double> numbers;
        std::size_t end = first;
        for (; end < names.size() && names[end].stem == names[first].stem && names[end].number;
             ++end)
            numbers.push_back(*names[end].number);
        if (const auto even = spacing_of(numbers))
            blocks.push_back({{first, end - first}, names[first], *even});
        first = std::max(end, first + 1);
    }
    return blocks;
}

/// The block that its name says it is, or else the longest that is no other.
const NamedBlock* ranges_among(const std::vector<NamedBlock>& blocks) {
    const NamedBlock* found = nullptr;
    for (const NamedBlock& block : blocks) {
        if (block.is_of_intensities()) continue;
        if (block.is_of_ranges()) return &block;
        if (found == nullptr || block.block.count > found->block.count) found = &block;
    }
    return found;
}

std::optional<RangeUnit> unit_in(const ColumnTitle& name) {
    if (name.has_word("mm")) return RangeUnit::millimetres;
    if (name.has_word("m")) return RangeUnit::metres;
    return std::nullopt;
}

bool is_in(std::size_t column, const std::optional<TableColumns::Block>& block) {
    return block && column >= block->first && column < block->first + block->count;
}

/// What a column beside the ranges is, if it is of use.
std::optional<std::size_t>* place_of(TableColumns& columns, const ColumnTitle& name) {
    if (name.has_word("stamp_ms")) return &columns.stamp_ms;
    if (name.has("angle_min")) return &columns.first_rad;
    if (name.has("angle_inc")) return &columns.increment_rad;
    if (name.has("increment") || name.has("scan_time")) return nullptr;
    if (name.has("time") || name.has("stamp")) return &columns.host_time;
    return nullptr;
}

std::string cell_text(std::size_t column, std::string_view cell) {
    return "column " + std::to_string(column + 1) + ": " + quote(cell);
}

std::string why_no_ranges(const std::vector<std::string_view>& names) {
    std::size_t words = 0;
    std::optional<std::size_t> first_word;
    for (std::size_t column = 0; column < names.size(); ++column) {
        if (number_in(names[column])) continue;
        if (!first_word) first_word = column;
        ++words;
    }
    if (!first_word) return "these numbers are neither angles nor steps";
    const std::string cell = cell_text(*first_word, names[*first_word]);
    if (2 * words < names.size()) return cell + " is no number";
    return cell +
           " and the other names here are none of ranges; name those by steps or angles, as "
           "range_0,range_1,range_2 does, or cut this line off: tail -n +2";
}

}  // namespace

Expected<TableColumns> columns_named(const std::vector<std::string_view>& cells) {
    std::vector<ColumnTitle> names;
    for (const std::string_view cell : cells)
        names.push_back(ColumnTitle::of(cell));
    take_dashes_for_minuses(names);
    const auto blocks = blocks_of(names);
    const NamedBlock* const ranges = ranges_among(blocks);
    if (ranges == nullptr) return refuse(why_no_ranges(cells));
    if (ranges->name.has_word("cm"))
        return refuse(cell_text(ranges->block.first, cells[ranges->block.first]) +
                      " is in centimetres; write millimetres or metres");
    TableColumns columns{.all = names.size(), .ranges = ranges->block};
    columns.unit = unit_in(ranges->name);
    columns.headed = "names";
    tell_directions(columns, ranges->even, ranges->name);
    for (const NamedBlock& block : blocks) {
        if (block.is_of_intensities() && block.block.count == columns.ranges.count)
            columns.intensities = block.block;
    }
    for (std::size_t column = 0; column < names.size(); ++column) {
        if (is_in(column, columns.ranges) || is_in(column, columns.intensities)) continue;
        std::optional<std::size_t>* const place = place_of(columns, names[column]);
        if (place != nullptr && !*place)
            *place = column;
        else
            columns.left_out.emplace_back(cells[column]);
    }
    return columns;
}

std::optional<TableColumns> columns_numbered(const std::vector<double>& numbers) {
    constexpr std::size_t fewest = 4;
    const auto even = spacing_of(numbers);
    TableColumns columns{.all = numbers.size(), .ranges = {0, numbers.size()}};
    if (!even || numbers.size() < fewest || !tell_directions(columns, *even, {}))
        return std::nullopt;
    return columns;
}

}  // namespace scipd::sim
