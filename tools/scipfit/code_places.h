// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What stands where there is no distance: which codes, how often, and where. Values; one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

#include "tools/scipfit/noise_fit.h"

namespace scipd::tools {

/// How often a code stands at each place.
struct CodeCounts {
    double inside = 0;  ///< between two steps without a distance
    double beside = 0;  ///< between one without and one with
    double edge = 0;    ///< between two with
    double pairs = 0;   ///< next to itself

    [[nodiscard]] double all() const { return inside + beside + edge; }
};

struct CodeShares {
    std::map<std::uint32_t, CodeCounts> codes;  ///< empty if the recording has no codes
    CodeCounts all;                             ///< of them
    double readings = 0;

    /// The code that stands there mostly. There are codes.
    [[nodiscard]] std::uint32_t usual() const;
};

[[nodiscard]] CodeShares codes_of(const ScanTable& readings);

/// How often a beam that sees a smooth face tells no distance.
struct LostBeams {
    double share = 0;
    double high = 0;  ///< the share is below that with 95 %
    double readings = 0;
};

[[nodiscard]] LostBeams lost_beams(const Standing& standing);

}  // namespace scipd::tools
