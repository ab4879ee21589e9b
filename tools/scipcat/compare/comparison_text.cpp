// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <array>
#include <cstddef>

#include "tools/scipcat/compare/comparison_report.h"
#include "tools/scipcat/compare/comparison_words.h"

namespace scipd::tools::comparing {
namespace {

using Cells = std::array<std::string, 5>;

/// In characters: the bytes that go on with one do not count.
std::size_t width_of(const std::string& text) {
    return static_cast<std::size_t>(
        std::ranges::count_if(text, [](char byte) { return (byte & 0xC0) != 0x80; }));
}

std::string table_of(const std::vector<Cells>& rows) {
    std::array<std::size_t, 5> widths{};
    for (const Cells& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i)
            widths[i] = std::max(widths[i], width_of(row[i]));
    }
    std::string text;
    for (const Cells& row : rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i)
            line += row[i] + std::string(widths[i] - width_of(row[i]) + 2, ' ');
        line.erase(line.find_last_not_of(' ') + 1);
        text += "  " + line + '\n';
    }
    return text;
}

}  // namespace

std::string as_text(const Comparison& comparison) {
    constexpr std::size_t most_shown = 20;
    std::string text = "A  " + comparison.a.name + ": " + scanner_of(comparison.a) + "\nB  " +
                       comparison.b.name + ": " + scanner_of(comparison.b) + "\n" +
                       place_of(comparison) + "\n\n";
    std::vector<Cells> rows{{"", "A", "B", "B − A", "detection limit"}};
    for (const Row& row : overview_of(comparison)) {
        if (!(row.a + row.b + row.difference).empty())
            rows.push_back({row.what, row.a, row.b, row.difference, row.floor});
    }
    text += table_of(rows) + "\n";
    if (const auto why = missing_floor(comparison); !why.empty()) text += why + "\n";
    text += verdict_of(comparison) + "\n";
    const auto differences = weightiest_first(comparison.differ);
    for (std::size_t i = 0; i < std::min(differences.size(), most_shown); ++i)
        text += "  " + sentence_of(differences[i]) + "\n";
    if (differences.size() > most_shown)
        text += "  and " + std::to_string(differences.size() - most_shown) +
                " smaller ones, which --json lists\n";
    return text;
}

}  // namespace scipd::tools::comparing
