// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scanner that tells the median of five neighbouring beams makes of noise. On a slope the
// median chooses the middle beam more often, so more noise is left there. Pure; any thread.
#pragma once

namespace scipd::tools {

/// How many times as much noise as on a wall that is met head-on, where the next beam is so many
/// deviations farther. It has 1 to 1.87.
[[nodiscard]] double median_noise_on_slope(double slope);

/// Its correlation with the beam that is `lag` (1 to 4) farther, on a wall that is met head-on.
[[nodiscard]] double median_correlation(int lag);

}  // namespace scipd::tools
