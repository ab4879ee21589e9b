// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/text/near_word.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <numeric>
#include <vector>

namespace scipd::sim {
namespace {

constexpr std::size_t longest_word = 32;

/// Levenshtein distance: letters to insert, drop or change, in any case (ust-10lx, UST-10LX).
std::size_t edits_between(std::string_view a, std::string_view b) {
    const auto lower = [](unsigned char c) { return std::tolower(c); };
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t changed = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row[b.size()];
}

}  // namespace

std::optional<std::string_view> meant(std::string_view word,
                                      std::span<const std::string_view> known) {
    if (word.size() >= longest_word || known.empty()) return std::nullopt;
    const auto edits = [word](std::string_view other) { return edits_between(word, other); };
    const auto nearest = std::ranges::min_element(known, {}, edits);
    // Two letters swapped are two edits.
    const std::size_t most_edits = nearest->size() > 3 ? 2 : 1;
    return edits(*nearest) <= most_edits ? std::optional(*nearest) : std::nullopt;
}

}  // namespace scipd::sim
