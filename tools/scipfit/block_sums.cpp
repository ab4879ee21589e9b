// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/block_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scipd::tools {
namespace {

constexpr std::size_t most_chunks = 40;
/// No scanner that was simulated has its noise from the same chances.
constexpr std::uint64_t apart_from_noise = 0x626f6f7473747261;
constexpr double of_95_percent = 1.96;

/// Adds the products of a scan's residuals.
void add_scan(const Station& station, const std::vector<float>& now, std::size_t chunk,
              StationSums& sums) {
    for (std::size_t beam = 0; beam < sums.beams; ++beam) {
        const float e = now[beam];
        if (std::isnan(e)) continue;
        const std::size_t at = sums.at(chunk, beam);
        sums.count[at] += 1.0F;
        sums.squares[at] += e * e;
        for (std::size_t lag = 1; lag <= most_lag && beam + lag < sums.beams; ++lag) {
            // Beyond the end of a face its neighbours share nothing.
            if (station.beams[beam + lag].end_before) break;
            if (!station.beams[beam + lag].inside || std::isnan(now[beam + lag])) continue;
            sums.beside[lag - 1][at] += e * now[beam + lag];
            sums.beside_count[lag - 1][at] += 1.0F;
        }
    }
}

}  // namespace

StationSums sums_of(const ScanTable& readings, const Station& station) {
    StationSums sums{.chunks = std::min(most_chunks, station.scans()), .beams = readings.beams};
    const std::size_t size = sums.chunks * sums.beams;
    for (auto* table : {&sums.count, &sums.squares, &sums.after, &sums.equal})
        table->assign(size, 0.0F);
    for (std::size_t lag = 0; lag < most_lag; ++lag) {
        sums.beside[lag].assign(size, 0.0F);
        sums.beside_count[lag].assign(size, 0.0F);
    }
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    std::vector<float> now(sums.beams, none);
    std::vector<float> before(sums.beams, none);
    for (std::size_t scan = station.first; scan < station.end; ++scan) {
        const std::size_t chunk = (scan - station.first) * sums.chunks / station.scans();
        for (std::size_t beam = 0; beam < sums.beams; ++beam) {
            const float mm = readings.range_mm(scan, beam);
            const bool counts = station.beams[beam].inside && is_distance(mm);
            now[beam] = counts
                            ? static_cast<float>(station.residual_mm(mm, scan, station.beams[beam]))
                            : none;
            const std::size_t at = sums.at(chunk, beam);
            if (counts && beam + 1 < sums.beams && mm == readings.range_mm(scan, beam + 1))
                sums.equal[at] += 1.0F;
            if (!std::isnan(now[beam]) && !std::isnan(before[beam]))
                sums.after[at] += now[beam] * before[beam];
        }
        add_scan(station, now, chunk, sums);
        std::swap(now, before);
    }
    return sums;
}

Weights::Weights(const std::vector<StationSums>& sums) {
    for (const StationSums& station : sums) {
        const std::size_t blocks = (station.beams + beams_of_block - 1) / beams_of_block;
        tables_.push_back({blocks, std::vector<float>(station.chunks * blocks, 1.0F)});
    }
}

Weights Weights::drawn(const std::vector<StationSums>& sums, std::uint64_t seed) {
    Weights weights(sums);
    std::uint64_t scan = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        Table& table = weights.tables_[i];
        const std::size_t chunks = sums[i].chunks;
        std::ranges::fill(table.weights, 0.0F);
        for (std::size_t block = 0; block < table.blocks; ++block) {
            const sim::Chance chance(
                {.seed = apart_from_noise + seed, .scan = scan++, .purpose = sim::Purpose::unit});
            for (std::size_t draw = 0; draw < chunks; ++draw)
                table.weights[drawn_of(chunks, chance, draw) * table.blocks + block] += 1.0F;
        }
    }
    return weights;
}

Weights Weights::half(const std::vector<StationSums>& sums, int which) {
    Weights weights(sums);
    for (std::size_t i = 0; i < sums.size(); ++i) {
        Table& table = weights.tables_[i];
        for (std::size_t chunk = 0; chunk < sums[i].chunks; ++chunk) {
            const int time = 2 * chunk < sums[i].chunks ? 0 : 1;
            for (std::size_t block = 0; block < table.blocks; ++block) {
                const bool in = time == which && static_cast<int>(block % 2) == which;
                table.weights[chunk * table.blocks + block] = in ? 1.0F : 0.0F;
            }
        }
    }
    return weights;
}

std::size_t drawn_of(std::size_t count, const sim::Chance& chance, std::size_t draw) {
    const double even = 0.5 * (1.0 + chance.even(static_cast<std::uint32_t>(draw)));
    return std::min(static_cast<std::size_t>(even * static_cast<double>(count)), count - 1);
}

Interval interval_of(double value, const std::vector<double>& drawn, bool positive) {
    double sum = 0.0;
    double squares = 0.0;
    for (const double one : drawn) {
        const double x = positive ? std::log(std::max(one, 1e-12)) : one;
        sum += x;
        squares += x * x;
    }
    const double n = static_cast<double>(drawn.size());
    const double deviation = std::sqrt(std::max(0.0, squares / n - sum / n * (sum / n)));
    // Over the first 200 of scipfit_round_trips the truth is 1.10 times as far off as blocks that
    // are drawn anew say. Where the room stays they are right: what is left is what laws leave out,
    // and that differs from room to room.
    constexpr double of_the_law = 1.1;
    // As many blocks as were there vary less among themselves than endless ones would.
    constexpr double of_few_chunks = 1.0 + 0.5 / most_chunks;
    const double half = of_95_percent * of_few_chunks * of_the_law * deviation;
    if (positive) return {value, value * std::exp(-half), value * std::exp(half)};
    return {value, value - half, value + half};
}

}  // namespace scipd::tools
