// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which product comes closest to a lidar that a world describes. Any thread; nothing shared.
#pragma once

#include <string>

#include "daemon/models/model.h"
#include "sim/world/lidar.h"

namespace scipd::daemon {

/// How far the product is from it in range, angles, steps and rate: 0 is the same, and a figure
/// that is off by a factor of e counts 1, whichever figure it is. What the file leaves open counts
/// nothing; the nearest range counts a tenth; of the range that the data sheet guarantees and the
/// one that the product reports (DMAX), the closer counts.
double misfit(const Model& model, const sim::Lidar& lidar);

/// The product that is the least far from it; of several the one that `--list-models` has first.
const Model& best_fit(const sim::Lidar& lidar);

/// "0.02 to 30 m instead of 0.12 to 3.5 m, 1081 steps instead of 360"; empty: none.
std::string differences(const Model& model, const sim::Lidar& lidar);

}  // namespace scipd::daemon
