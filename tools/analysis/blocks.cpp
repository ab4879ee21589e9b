// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/analysis/blocks.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace scipd::tools {
namespace {

constexpr std::size_t draws = 1000;
constexpr std::uint32_t seed = 1979;

/// The numbers of std::mt19937 are the same everywhere; those of the standard's distributions are
/// not.
Draw draw_blocks(std::size_t blocks, std::mt19937& chance) {
    Draw draw(blocks, 0.0);
    for (std::size_t i = 0; i < blocks; ++i)
        ++draw[chance() % blocks];
    return draw;
}

}  // namespace

std::size_t blocks_for(std::size_t scans) {
    constexpr std::size_t fewest = 20;
    constexpr std::size_t most = 40;
    constexpr std::size_t scans_a_block = 5;
    if (scans <= fewest) return scans;
    return std::clamp(scans / scans_a_block, fewest, most);
}

std::vector<ScanSpan> blocks_of(ScanSpan scans) {
    const std::size_t count = blocks_for(scans.count());
    std::vector<ScanSpan> blocks;
    for (std::size_t i = 0; i < count; ++i)
        blocks.push_back({scans.first + i * scans.count() / count,
                          scans.first + (i + 1) * scans.count() / count});
    return blocks;
}

Interval bootstrap(std::size_t blocks_a, std::size_t blocks_b,
                   const std::function<double(const Draw&, const Draw&)>& statistic) {
    std::mt19937 chance(seed);
    std::vector<double> values;
    for (std::size_t i = 0; i < draws; ++i) {
        const Draw a = draw_blocks(blocks_a, chance);
        const Draw b = draw_blocks(blocks_b, chance);
        const double value = statistic(a, b);
        if (std::isfinite(value)) values.push_back(value);
    }
    return {quantile_of(values, 0.025), quantile_of(values, 0.975)};
}

}  // namespace scipd::tools
