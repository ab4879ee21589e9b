// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/lattice.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace scipd::tools {
namespace {

constexpr std::size_t range_end_mm = 65536;
/// A cell of a millimetre is judged by so many on either side.
constexpr std::size_t around = 12;

/// A millimetre, and how often it occurs, in those of its neighbours.
struct Cell {
    std::size_t mm;
    double share;
};

constexpr double sure = 15.0;

/// How often each millimetre occurs.
std::vector<double> counts_of(const ScanTable& readings) {
    std::vector<double> count(range_end_mm, 0.0);
    for (const float mm : readings.ranges_mm) {
        if (is_distance(mm) && mm < static_cast<float>(range_end_mm))
            count[static_cast<std::size_t>(mm)] += 1.0;
    }
    return count;
}

/// The cells with so many distances around them that an empty one is no chance.
std::vector<Cell> cells_of(const std::vector<double>& count) {
    constexpr double least_side = 0.25;
    std::vector<Cell> cells;
    double below = 0.0;
    double above = 0.0;
    for (std::size_t i = 0; i < around; ++i) {
        below += count[i];
        above += count[around + 1 + i];
    }
    for (std::size_t mm = around; mm + around + 1 < range_end_mm; ++mm) {
        const double mean = (below + count[mm] + above) / (2 * around + 1);
        // At the foot of a wall's distances there is nothing to one side.
        if (mean > sure && std::min(below, above) > least_side * around * mean)
            cells.push_back({mm, count[mm] / mean});
        below += count[mm] - count[mm - around];
        above += count[mm + around + 1] - count[mm + 1];
    }
    return cells;
}

/// The cells around multiples of so many millimetres that occur often, as those beside them do.
Lattice of_whole_mm(std::size_t spacing_mm, const std::vector<double>& count) {
    Lattice lattice{.spacing_mm = static_cast<double>(spacing_mm)};
    for (std::size_t mm = spacing_mm; mm + spacing_mm < range_end_mm; mm += spacing_mm) {
        if (std::min({count[mm - spacing_mm], count[mm], count[mm + spacing_mm]}) < sure) continue;
        lattice.cells += spacing_mm;
        lattice.missing += static_cast<std::size_t>(
            std::count(count.begin() + static_cast<std::ptrdiff_t>(mm),
                       count.begin() + static_cast<std::ptrdiff_t>(mm + spacing_mm), 0.0));
    }
    return lattice;
}

/// The most millimetres of which nearly all distances are multiples.
Lattice whole_lattice(const std::vector<double>& count) {
    constexpr double nearly = 0.999;
    constexpr std::size_t least_places = 12;
    constexpr std::size_t largest_mm = 100;
    const double all = std::accumulate(count.begin(), count.end(), 0.0);
    for (std::size_t spacing_mm = largest_mm; spacing_mm > 1; --spacing_mm) {
        double on = 0.0;
        for (std::size_t mm = 0; mm < range_end_mm; mm += spacing_mm)
            on += count[mm];
        if (on < nearly * all) continue;
        Lattice lattice = of_whole_mm(spacing_mm, count);
        lattice.known = lattice.cells >= least_places * spacing_mm;
        if (lattice.known) return lattice;
    }
    return {};
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

Lattice lattice_of(const ScanTable& readings) {
    constexpr double least_missing = 0.08;
    constexpr double most_uneven = 0.15;
    constexpr std::size_t least_cells = 50;
    if (!readings.whole_mm) return {};
    const std::vector<double> count = counts_of(readings);
    if (const Lattice whole = whole_lattice(count); whole.known) return whole;
    const std::vector<Cell> cells = cells_of(count);
    Lattice lattice{.cells = cells.size()};
    if (cells.size() < least_cells) return lattice;
    lattice.missing = static_cast<std::size_t>(
        std::ranges::count_if(cells, [](const Cell& cell) { return cell.share < 0.02; }));
    const double missing = static_cast<double>(lattice.missing) / static_cast<double>(cells.size());
    lattice.known = missing < least_missing;
    // A lattice of q millimetres leaves out 1 - 1/q of them. Larger ones look like walls.
    constexpr double off = 0.07;
    constexpr double largest_mm = 8.0;
    const double expected_mm = 1.0 / (1.0 - missing);
    if (lattice.known || expected_mm > largest_mm) return lattice;
    const std::vector<double> row = row_of(cells);
    const auto first_mm = static_cast<double>(cells.front().mm);
    double best = most_uneven;
    for (double spacing_mm = expected_mm * (1.0 - off); spacing_mm < expected_mm * (1.0 + off);
         spacing_mm += 2e-5) {
        const double uneven = unevenness(spacing_mm, row, first_mm);
        if (uneven >= best) continue;
        best = uneven;
        lattice.spacing_mm = spacing_mm;
        lattice.known = true;
    }
    return lattice;
}

}  // namespace scipd::tools
