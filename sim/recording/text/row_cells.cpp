// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/text/row_cells.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <string>

#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

char separator_of(std::string_view line) {
    for (const char separator : {';', ','}) {
        if (line.find(separator) != line.npos) return separator;
    }
    return ' ';
}

/// Takes the next cell off the front.
std::string_view take_cell(std::string_view& line, char separator) {
    const std::size_t end = separator == ' ' ? line.find_first_of(" \t") : line.find(separator);
    const std::string_view cell = line.substr(0, end);
    line.remove_prefix(std::min(cell.size() + 1, line.size()));
    line = trimmed(line);
    return trimmed(cell);
}

}  // namespace

std::vector<std::string_view> cells_of(std::string_view line) {
    const char separator = separator_of(line);
    std::vector<std::string_view> cells;
    while (!line.empty())
        cells.push_back(take_cell(line, separator));
    return cells;
}

std::optional<double> number_in(std::string_view cell) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    std::string word(cell);
    std::ranges::transform(word, word.begin(), [](unsigned char c) { return std::tolower(c); });
    if (word.empty() || word == "nan") return std::numeric_limits<double>::quiet_NaN();
    if (word.starts_with('+')) word.erase(0, 1);
    if (word == "inf") return infinite;
    if (word == "-inf") return -infinite;
    return parse_number(word);
}

std::string_view row_in(std::string_view line) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    if (line.starts_with(mark)) line.remove_prefix(mark.size());
    return trimmed(line);
}

}  // namespace scipd::sim
