// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

namespace scipd::sim {

/// Standard deviation of a range: sigma_m + sigma_share * range from this range on.
struct NoiseStep {
    double from_range_m;
    double sigma_m;
    double sigma_share;

    bool operator==(const NoiseStep&) const = default;
};

}  // namespace scipd::sim
