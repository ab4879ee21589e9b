// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/lattice.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace scipd::tools {
namespace {

constexpr std::size_t farthest_mm = 65536;
/// A cell of a millimetre is judged by so many on either side.
constexpr std::size_t around = 12;

/// A millimetre, and how often it occurs, in those of its neighbours.
struct Cell {
    std::size_t mm;
    double share;
};

/// The cells with so many distances around them that an empty one is no chance.
std::vector<Cell> cells_of(const Readings& readings) {
    constexpr double sure = 15.0;
    std::vector<double> count(farthest_mm, 0.0);
    for (const float mm : readings.mm) {
        if (is_distance(mm) && mm < static_cast<float>(farthest_mm))
            count[static_cast<std::size_t>(mm)] += 1.0;
    }
    std::vector<Cell> cells;
    double sum = 0.0;
    for (std::size_t mm = 0; mm < 2 * around; ++mm)
        sum += count[mm];
    for (std::size_t mm = around; mm + around < farthest_mm; ++mm) {
        sum += count[mm + around];
        const double mean = sum / (2 * around + 1);
        // At the foot of a wall's distances there is nothing to either side.
        const double near = count[mm - 1] + count[mm + 1] + count[mm - 2] + count[mm + 2];
        if (mean > sure && near > mean) cells.push_back({mm, count[mm] / mean});
        sum -= count[mm - around];
    }
    return cells;
}

/// The cells by their millimetre, from the first to the last; none: below 0.
std::vector<double> row_of(const std::vector<Cell>& cells) {
    std::vector<double> row(cells.back().mm - cells.front().mm + 2, -1.0);
    for (const Cell& cell : cells)
        row[cell.mm - cells.front().mm] = cell.share;
    return row;
}

/// How unevenly the points of a lattice would be hit: 0 where each gets its share of the distances.
/// What lies in the middle of two millimetres may be told as either.
double unevenness(double spacing_mm, const std::vector<double>& row, double first_mm) {
    constexpr double tie = 0.03;
    double squares = 0.0;
    double count = 0.0;
    const double last_mm = first_mm + static_cast<double>(row.size()) - 2.0;
    for (double k = std::ceil(first_mm / spacing_mm); k * spacing_mm < last_mm; k += 1.0) {
        const double place = k * spacing_mm - first_mm;
        const double whole = std::floor(place);
        const auto below = static_cast<std::size_t>(whole);
        const double part = place - whole;
        double hits = part < 0.5 ? row[below] : row[below + 1];
        if (hits < 0.0) continue;
        if (std::abs(part - 0.5) < tie) {
            if (row[below] < 0.0 || row[below + 1] < 0.0) continue;
            hits = row[below] + row[below + 1];
        }
        squares += (hits / spacing_mm - 1.0) * (hits / spacing_mm - 1.0);
        count += 1.0;
    }
    return count > 0.0 ? squares / count : 1.0;
}

}  // namespace

double Lattice::rounding_mm2(bool whole_mm) const {
    const double of_lattice = spacing_mm * spacing_mm / 12.0;
    if (!whole_mm) return of_lattice;
    if (spacing_mm == 0.0) return 1.0 / 12.0;
    // What is left to round to millimetres: the mean square over the lattice.
    double left = 0.0;
    constexpr int places = 1000;
    for (int i = 0; i < places; ++i) {
        const double value = i * spacing_mm;
        left += (value - std::round(value)) * (value - std::round(value)) / places;
    }
    return of_lattice + left;
}

Lattice lattice_of(const Readings& readings) {
    constexpr double least_missing = 0.08;
    constexpr double most_uneven = 0.15;
    constexpr std::size_t least_cells = 50;
    if (!readings.whole_mm) return {};
    const std::vector<Cell> cells = cells_of(readings);
    Lattice lattice{.cells = cells.size()};
    if (cells.size() < least_cells) return lattice;
    lattice.missing = static_cast<std::size_t>(
        std::ranges::count_if(cells, [](const Cell& cell) { return cell.share < 0.02; }));
    const double missing = static_cast<double>(lattice.missing) / static_cast<double>(cells.size());
    if (missing < least_missing) return lattice;
    // A lattice of q millimetres leaves out 1 - 1/q of them. Larger ones look like walls.
    constexpr double off = 0.07;
    constexpr double largest_mm = 8.0;
    const double expected_mm = 1.0 / (1.0 - missing);
    if (expected_mm > largest_mm) return lattice;
    const std::vector<double> row = row_of(cells);
    const auto first_mm = static_cast<double>(cells.front().mm);
    double best = most_uneven;
    for (double spacing_mm = expected_mm * (1.0 - off); spacing_mm < expected_mm * (1.0 + off);
         spacing_mm += 2e-5) {
        const double uneven = unevenness(spacing_mm, row, first_mm);
        if (uneven >= best) continue;
        best = uneven;
        lattice.spacing_mm = spacing_mm;
    }
    return lattice;
}

}  // namespace scipd::tools
