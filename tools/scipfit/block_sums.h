// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What residuals add up to in blocks of some scans and twenty beams: enough to estimate anew from
// any choice of blocks, in no time. Neighbouring beams share their noise, so intervals that count
// beams one by one come out too narrow by a factor of 1.2 to 1.5. Values; one thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/random.h"
#include "tools/scipfit/standing.h"

namespace scipd::tools {

inline constexpr std::size_t most_lag = 4;
inline constexpr std::size_t beams_of_block = 20;

/// The sums of one station, for each chunk of its scans and each beam.
struct StationSums {
    std::size_t chunks = 0;
    std::size_t beams = 0;
    std::vector<float> count;                         ///< of residuals
    std::vector<float> squares;                       ///< of residuals, in mm²
    std::vector<float> after;                         ///< products with those of the next scan
    std::array<std::vector<float>, most_lag> beside;  ///< products with those of later beams
    std::array<std::vector<float>, most_lag> beside_count;
    std::vector<float> equal;  ///< how often the next beam reads the same

    [[nodiscard]] std::size_t at(std::size_t chunk, std::size_t beam) const {
        return chunk * beams + beam;
    }
};

[[nodiscard]] StationSums sums_of(const ScanTable& readings, const Station& station);

/// How often each block counts.
class Weights {
  public:
    /// Each once.
    explicit Weights(const std::vector<StationSums>& sums);
    /// Chunks drawn with replacement, anew for each block of beams.
    static Weights drawn(const std::vector<StationSums>& sums, std::uint64_t seed);
    /// The first or the second half of the time, at every other block of beams.
    static Weights half(const std::vector<StationSums>& sums, int which);

    [[nodiscard]] float of(std::size_t station, std::size_t chunk, std::size_t beam) const {
        const Table& table = tables_[station];
        return table.weights[chunk * table.blocks + beam / beams_of_block];
    }

  private:
    struct Table {
        std::size_t blocks;
        std::vector<float> weights;
    };
    std::vector<Table> tables_;
};

/// One of `count`, drawn with replacement: another one for each `draw`.
[[nodiscard]] std::size_t drawn_of(std::size_t count, const sim::Chance& chance, std::size_t draw);

/// Replicates of an estimate, and the interval that they give.
inline constexpr int replicates = 200;

struct Interval {
    double value = 0.0;
    double low = 0.0;
    double high = 0.0;
};

/// 95 %, from the standard deviation of the replicates; `positive`: of their logarithms, so that it
/// does not reach below 0.
[[nodiscard]] Interval interval_of(double value, const std::vector<double>& drawn, bool positive);

}  // namespace scipd::tools
