// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scanner reads too far, by a length that somebody has measured. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "tools/scipfit/block_sums.h"

namespace scipd::tools {

/// A distance that somebody has measured between what two steps see.
struct Length {
    int from_step = 0;
    int to_step = 0;
    double metres = 0.0;
};

/// What the scanner reads too far at a range.
struct BiasAt {
    double range_mm = 0.0;
    Interval bias_mm;
    std::string how;  ///< "3.2 m from step 180 to step 900"
};

/// One length tells one number: what both of its ends are read too far, at their mean range. Throws
/// WrongInput where a step is not recorded or sees nothing that stands still, and where no bias
/// makes it that long.
[[nodiscard]] BiasAt bias_by(const Length& length, const ScanTable& readings,
                             const std::vector<Station>& stations);

/// "120:960=3.2m". Throws WrongInput.
[[nodiscard]] Length parse_length_between(const std::string& text);

}  // namespace scipd::tools
