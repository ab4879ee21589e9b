// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipctl/table.h"

#include <algorithm>
#include <cstddef>

#include "sim/text/quote.h"

namespace scipd::tools {
namespace {

/// Removes line ends and tabs, so that no cell can look like another row.
std::string in_a_line(const std::string& cell) {
    std::string text = sim::shown(cell);
    const auto divides = [](char c) { return c == '\n' || c == '\t'; };
    std::ranges::replace_if(text, divides, ' ');
    return text;
}

}  // namespace

void print_table(std::ostream& out, std::vector<Row> rows) {
    for (Row& row : rows) {
        for (std::string& cell : row)
            cell = in_a_line(cell);
    }
    std::vector<std::size_t> widths;
    for (const Row& row : rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i)
            widths[i] = std::max(widths[i], row[i].size());
    }
    for (const Row& row : rows) {
        for (std::size_t i = 0; i + 1 < row.size(); ++i)
            out << row[i] << std::string(widths[i] - row[i].size() + 2, ' ');
        out << row.back() << '\n';
    }
}

}  // namespace scipd::tools
