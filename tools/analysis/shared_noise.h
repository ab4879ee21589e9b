// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What neighbouring beams have in common beyond what they look at: software that averages them
// depends on it. Functions of numbers; any thread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tools/analysis/beam_statistics.h"

namespace scipd::tools {

/// Sums over pairs of beams, so that those of several scans can be added up.
struct SharedNoise {
    double products = 0;  ///< of the deviations of both beams
    double squares = 0;   ///< of those of one
    double next_squares = 0;

    SharedNoise& operator+=(const SharedNoise& other);
    /// NaN where there was no noise.
    [[nodiscard]] double correlation() const;
};

/// What pairs of beams share that are `apart` steps from each other. Both must be steady and look
/// at no edge. `beams` are the means about which they deviate.
[[nodiscard]] SharedNoise shared_noise(const ScanTable& series,
                                       std::span<const BeamStatistics> beams,
                                       const std::vector<bool>& beside_edges, ScanSpan scans,
                                       std::size_t apart = 1);

}  // namespace scipd::tools
