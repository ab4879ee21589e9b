// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "sim/recording/text/table_row.h"
#include "sim/recording/text/text_formats.h"
#include "sim/recording/text/text_recording.h"
#include "sim/recording/values/recorded_scan.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

using table::Block;
using table::Cells;

/// A title above a column: "field.ranges12" is "field.ranges" and 12.
struct Title {
    std::string stem;  ///< in lower case
    std::optional<double> number;

    [[nodiscard]] bool has(std::string_view part) const { return stem.find(part) != stem.npos; }
    /// True if no letter is beside the word.
    [[nodiscard]] bool has_word(std::string_view word) const {
        const auto is_letter = [&](std::size_t index) {
            return index < stem.size() && std::isalpha(static_cast<unsigned char>(stem[index]));
        };
        for (std::size_t at = stem.find(word); at != stem.npos; at = stem.find(word, at + 1)) {
            if (!is_letter(at - 1) && !is_letter(at + word.size())) return true;
        }
        return false;
    }
    [[nodiscard]] bool is_of_intensities() const {
        return has("intensit") || has("remission") || has("rssi") || has("reflect");
    }
    [[nodiscard]] bool is_of_ranges() const { return has("rang") || has("dist"); }
};

/// A minus behind a letter or a digit is a dash.
Title title_of(std::string_view cell) {
    constexpr std::size_t longest_number = 40;
    std::string text(cell);
    std::erase(text, '"');
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    text.erase(text.find_last_not_of("])} ") + 1);
    std::size_t at = text.size() - std::min(text.size(), longest_number);
    for (; at < text.size(); ++at) {
        const bool minus = text[at] == '-';
        if (minus && at > 0 && std::isalnum(static_cast<unsigned char>(text[at - 1])) != 0)
            continue;
        if (std::isdigit(static_cast<unsigned char>(text.c_str()[at + (minus ? 1 : 0)])) == 0)
            continue;
        const auto number = parse_number(std::string_view(text).substr(at));
        if (number) return {text.substr(0, at), number};
    }
    return {text, std::nullopt};
}

/// "range-1" beside "range1" is of an angle below 0: its dash is a minus.
std::vector<Title> titles_of(const Cells& cells) {
    std::vector<Title> titles;
    std::set<std::string> stems;
    for (const std::string_view cell : cells) {
        titles.push_back(title_of(cell));
        if (titles.back().number) stems.insert(titles.back().stem);
    }
    for (Title& title : titles) {
        if (!title.number || !title.stem.ends_with('-')) continue;
        const std::string stem = title.stem.substr(0, title.stem.size() - 1);
        if (stems.contains(stem)) title = {stem, -*title.number};
    }
    return titles;
}

/// Numbers that go up or down evenly; rounded ones may be a little off.
struct Spacing {
    double first = 0;
    double last = 0;
    double step = 0;

    [[nodiscard]] bool whole() const {
        return first == std::floor(first) && step == std::floor(step);
    }
    /// True if they are angles of one revolution.
    [[nodiscard]] bool fits(double revolution) const {
        const double most = revolution + std::abs(step);
        return std::abs(last - first) <= most && std::abs(first) <= most && std::abs(last) <= most;
    }
};

std::optional<Spacing> spacing_of(std::span<const double> numbers, std::size_t fewest) {
    constexpr double rounded = 0.25;
    if (numbers.size() < fewest) return std::nullopt;
    const auto steps = static_cast<double>(numbers.size() - 1);
    const Spacing even{numbers.front(), numbers.back(), (numbers.back() - numbers.front()) / steps};
    if (!std::isfinite(even.step) || even.step == 0) return std::nullopt;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double place = even.first + even.step * static_cast<double>(i);
        if (!(std::abs(numbers[i] - place) <= rounded * std::abs(even.step))) return std::nullopt;
    }
    return even;
}

/// Columns beside each other whose titles are the same but for evenly spaced numbers.
struct TitledBlock {
    Block columns;
    Title title;
    Spacing even;
};

std::vector<TitledBlock> blocks_under(const std::vector<Title>& titles) {
    constexpr std::size_t fewest = 3;
    std::vector<TitledBlock> blocks;
    for (std::size_t first = 0, end = 0; first < titles.size(); first = std::max(end, first + 1)) {
        std::vector<double> numbers;
        for (end = first;
             end < titles.size() && titles[end].stem == titles[first].stem && titles[end].number;
             ++end)
            numbers.push_back(*titles[end].number);
        if (const auto even = spacing_of(numbers, fewest))
            blocks.push_back({{first, end - first}, titles[first], *even});
    }
    return blocks;
}

/// The first block of ranges by its title, or else the longest that is not of intensities.
const TitledBlock* ranges_among(const std::vector<TitledBlock>& blocks) {
    const TitledBlock* found = nullptr;
    for (const TitledBlock& block : blocks) {
        if (block.title.is_of_intensities()) continue;
        if (block.title.is_of_ranges()) return &block;
        if (found == nullptr || block.columns.steps > found->columns.steps) found = &block;
    }
    return found;
}

/// A table by its first rows.
struct Table {
    std::size_t columns = 0;
    table::Description description = {};
    std::string type = "rows of numbers";
    ScannerIdentity identity = {};
    bool has_titles = false;
    bool names_unit = false;
    Cells left_out = {};  ///< titles of columns that are not read
};

/// Sets steps or angles. Whole numbers from 0 on are steps unless the title says otherwise, and
/// angles that fit into one revolution of radians are radians. Returns false if they are neither.
bool set_directions(Table& table, const Spacing& even, const Title& title) {
    constexpr double revolution_rad = 2 * std::numbers::pi;
    constexpr double most_steps = 1e5;
    Directions& directions = table.description.blank.directions;
    const bool angles = title.has("angle") || title.has_word("deg") || title.has_word("rad");
    if (!angles && even.whole() && even.step > 0 && even.first >= 0 && even.last < most_steps) {
        directions.first_step = static_cast<int>(even.first);
        directions.cluster = static_cast<int>(even.step);
        table.type += " under numbers of steps";
        return true;
    }
    const bool degrees = title.has_word("deg") ||
                         (!title.has_word("rad") && (even.whole() || !even.fits(revolution_rad)));
    if (!even.fits(degrees ? 360 : revolution_rad)) return false;
    const double unit_rad = degrees ? std::numbers::pi / 180 : 1;
    directions.first_rad = even.first * unit_rad;
    directions.increment_rad = even.step * unit_rad;
    table.type += degrees ? " under angles in degrees" : " under angles in radians";
    return true;
}

std::string cell_text(const Cells& cells, std::size_t column) {
    return "column " + std::to_string(column + 1) + ": " + quote(cells[column]);
}

std::string why_no_ranges(const Cells& cells) {
    const auto is_word = [](std::string_view cell) { return !table::number_in(cell); };
    const auto first = std::ranges::find_if(cells, is_word);
    if (first == cells.end()) return "these numbers are neither angles nor steps";
    const std::string cell = cell_text(cells, static_cast<std::size_t>(first - cells.begin()));
    if (2 * static_cast<std::size_t>(std::ranges::count_if(cells, is_word)) < cells.size())
        return cell + " is no number";
    return cell +
           " and the other names here are none of ranges; name those by steps or angles, as "
           "range_0,range_1,range_2 does, or cut this line off: tail -n +2";
}

/// The column of a title beside the ranges; null if it is of no use.
table::Column* column_titled(const Title& title, table::Columns& columns) {
    if (title.has_word("stamp_ms")) return &columns.stamp_ms;
    if (title.has("angle_min")) return &columns.first_rad;
    if (title.has("angle_inc")) return &columns.increment_rad;
    if (title.has("increment") || title.has("scan_time")) return nullptr;
    return title.has("time") || title.has("stamp") ? &columns.host_time : nullptr;
}

Expected<Table> table_under(const Cells& cells) {
    const std::vector<Title> titles = titles_of(cells);
    const auto blocks = blocks_under(titles);
    const TitledBlock* const ranges = ranges_among(blocks);
    if (ranges == nullptr) return refuse(why_no_ranges(cells));
    if (ranges->title.has_word("cm"))
        return refuse(cell_text(cells, ranges->columns.first) +
                      " is in centimetres; write millimetres or metres");
    Table table{.columns = cells.size(), .has_titles = true};
    if (!set_directions(table, ranges->even, ranges->title)) table.type += " under names";
    const bool millimetres = ranges->title.has_word("mm");
    table.names_unit = millimetres || ranges->title.has_word("m");
    if (!millimetres) table.description.blank.unit = RangeUnit::metres;
    std::vector<Block>& read = table.description.blocks = {ranges->columns};
    for (const TitledBlock& block : blocks) {
        if (!block.title.is_of_intensities() || block.columns.steps != read.front().steps) continue;
        read.resize(1);
        read.push_back(block.columns);
        read.back().intensities = true;
    }
    for (std::size_t column = 0; column < cells.size(); ++column) {
        const auto has_it = [&](const Block& block) { return column - block.first < block.steps; };
        if (std::ranges::any_of(read, has_it)) continue;
        auto* const place = column_titled(titles[column], table.description.columns);
        if (place != nullptr && !*place)
            *place = static_cast<int>(column);
        else
            table.left_out.push_back(cells[column]);
    }
    const table::Columns& beside = table.description.columns;
    // `rostopic echo -p` numbers ranges from 0 on, whatever their angles are.
    if (beside.first_rad && beside.increment_rad) table.description.blank.directions = {};
    return table;
}

/// NaN in place of a cell that is no number.
std::vector<double> numbers_in(std::span<const std::string_view> cells) {
    std::vector<double> numbers;
    for (const std::string_view cell : cells)
        numbers.push_back(
            table::number_in(cell).value_or(std::numeric_limits<double>::quiet_NaN()));
    return numbers;
}

/// Numbers alone are titles if they are evenly spaced steps or angles.
std::optional<Table> table_under(std::span<const double> numbers) {
    constexpr std::size_t fewest = 4;
    Table table{.columns = numbers.size(), .has_titles = true};
    const auto even = spacing_of(numbers, fewest);
    if (!even || !set_directions(table, *even, {})) return std::nullopt;
    table.description.blocks = {{0, numbers.size()}};
    return table;
}

/// A row of CoreSLAM begins with a time in microseconds, the odometry and other values of a robot.
/// One more number may be behind the 682 steps of a URG-04LX, from step 44 on.
std::optional<Table> core_slam_table(std::span<const double> row) {
    constexpr std::size_t in_front = 24;
    constexpr std::size_t steps = 682;
    constexpr double no_range = 65536;  // a time, therefore
    const bool long_enough = row.size() == in_front + steps || row.size() == in_front + steps + 1;
    if (!long_enough || !(row[0] >= no_range && row[0] < 1e15)) return std::nullopt;
    const auto is_whole = [](double range) { return range == std::floor(range); };
    if (!std::ranges::all_of(row.subspan(in_front), is_whole)) return std::nullopt;
    Table table{.columns = row.size(), .type = "CoreSLAM", .names_unit = true};
    table.identity = {.model = "URG-04LX",
                      .min_range_m = 0.02,
                      .max_range_m = 5.6,
                      .steps_per_turn = 1024,
                      .front_step = 384};
    table.description = {.columns = {.stamp_us = 0}, .blocks = {{in_front, steps}}};
    table.description.blank.directions = with_angles({.first_step = 44}, table.identity);
    return table;
}

std::string why_no_number(const Cells& cells, std::size_t column) {
    const bool comma = cells[column].find(',') != std::string_view::npos;
    return cell_text(cells, column) + " is no number" + (comma ? "; write decimal points" : "");
}

Expected<Table> table_without_titles(const Cells& first) {
    constexpr double no_range = 1e6;  // SCIP's largest range is 262 143 mm
    const auto numbers = numbers_in(first);
    for (std::size_t column = 0; column < first.size(); ++column) {
        if (!table::number_in(first[column])) return refuse(why_no_number(first, column));
    }
    if (auto table = core_slam_table(numbers)) return *std::move(table);
    for (std::size_t column = 0; column < first.size(); ++column) {
        if (std::isfinite(numbers[column]) && std::abs(numbers[column]) >= no_range)
            return refuse(cell_text(first, column) +
                          " is no range; leave out the columns that are none, such as times: cut "
                          "-d, -f2-");
    }
    return Table{.columns = first.size(), .description = {.blocks = {{0, first.size()}}}};
}

bool has_letters(std::string_view cell) {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_[\"";
    return !table::number_in(cell) && cell.find_first_of(letters) != cell.npos;
}

/// Evenly spaced numbers are titles, unless those of the next row are evenly spaced as well.
Expected<Table> table_of(const Cells& first, const Cells& second) {
    constexpr std::size_t most_columns = 1'000'000;
    if (first.size() > most_columns)
        return refuse("a row of " + std::to_string(first.size()) + " cells is no scan");
    if (std::ranges::any_of(first, has_letters)) return table_under(first);
    const auto numbers = numbers_in(first);
    // pandas writes its index in front, under no name.
    const bool has_index = first.size() > 1 && first.front().empty();
    if (has_index && table_under(std::span(numbers).subspan(1))) return table_under(first);
    auto titled = table_under(numbers);
    if (titled && !second.empty() && !table_under(numbers_in(second))) return *std::move(titled);
    return table_without_titles(first);
}

Cells take_row(std::string_view& text) {
    while (!text.empty()) {
        const std::string_view line = take_until(text, "\n");
        if (!table::is_no_row(line)) return table::cells_of(line);
    }
    return {};
}

/// The unit is guessed by the ranges of all rows.
void guess_unit(Table& table, std::string_view text) {
    LikelyUnit likely;
    const Block& ranges = table.description.blocks.front();
    if (table.has_titles) take_row(text);
    for (Cells row = take_row(text); !row.empty(); row = take_row(text)) {
        const std::size_t end = std::min(ranges.first + ranges.steps, row.size());
        for (std::size_t column = ranges.first; column < end; ++column) {
            const bool point = row[column].find_first_of(".eE") != std::string_view::npos;
            if (const auto range = table::number_in(row[column])) likely.show(*range, point);
        }
    }
    table.description.blank.unit = likely.unit();
    table.type +=
        likely.unit() == RangeUnit::metres ? ", taken for metres" : ", taken for millimetres";
}

class TableRecording final : public TextRecording {
  public:
    /// `beginning`: of the file, up to the longest line.
    TableRecording(InputFile file, std::string_view beginning)
        : TextRecording("rows", std::move(file)) {
        const std::string_view text = behind_byte_order_mark(beginning);
        std::string_view rest = text;
        const Cells first = take_row(rest);
        table_ = table_of(first, take_row(rest));
        if (table_ && !table_->names_unit) guess_unit(*table_, text);
        add_stream({.name = "scanner",
                    .type = table_ ? table_->type : "rows of numbers",
                    .identity = table_ ? table_->identity : ScannerIdentity{}});
        if (!table_ || table_->left_out.empty()) return;
        const std::size_t more = table_->left_out.size() - 1;
        warn(file_name() + ": these columns are left out: " + quote(table_->left_out.front()) +
             (more > 0 ? " and " + std::to_string(more) + " more" : ""));
        table_->left_out.clear();
    }

  private:
    Next take(std::string_view line) override {
        if (table::is_no_row(line)) return std::nullopt;
        if (!table_) return tl::unexpected(table_.error());
        if (std::exchange(table_->has_titles, false)) return std::nullopt;
        const Cells cells = table::cells_of(line, table::any_separator, table_->columns);
        if (cells.size() != table_->columns)
            return refuse("must have " + std::to_string(table_->columns) +
                          " numbers as the first row, not " + std::to_string(cells.size()));
        auto scan = table::scan_of(cells, table_->description);
        if (!scan) return refuse(why_no_number(cells, scan.error()));
        // Times of before 1973 are since the log began, and no Unix time.
        constexpr std::int64_t earliest_s = 100'000'000;
        if (scan->host_time && *scan->host_time < host_time_at(earliest_s)) scan->host_time.reset();
        return RecordedItem{0, *std::move(scan)};
    }

    Expected<Table> table_;
};

}  // namespace

bool is_row_of_numbers(std::string_view line) {
    line = trimmed(line);
    // Decimal commas included: such a table is refused as one.
    constexpr std::string_view letters = "0123456789+-.,; \tenaifENAIF";
    return line.find_first_of("0123456789") != line.npos &&
           line.find_first_of(" \t,;") != line.npos && line.find_first_not_of(letters) == line.npos;
}

bool is_row_of_titles(std::string_view line) {
    return table_under(table::cells_of(line)).has_value();
}

Expected<std::unique_ptr<Recording>> open_table(InputFile file) {
    const auto beginning = file.read(0, TextRecording::longest_line);
    if (!beginning) return tl::unexpected(beginning.error());
    return std::make_unique<TableRecording>(std::move(file), *beginning);
}

}  // namespace scipd::sim
