// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds the product that comes closest to a lidar in a world. Any thread; nothing shared.
#pragma once

#include <string>

#include "daemon/models/model.h"
#include "sim/world/lidar.h"

namespace scipd::daemon {

/// How far the product is from the lidar in range, angles, steps and rate. 0 means equal. Each
/// figure that is off by a factor of e adds 1, but the nearest range adds a tenth of that, and a
/// field of view that is too narrow four times as much. Figures that the world's file leaves open
/// add nothing. A product has two farthest ranges: the one that its data sheet guarantees and the
/// one that it reports (DMAX). The closer one counts.
double misfit(const Model& model, const sim::Lidar& lidar);

/// The product with the least misfit; of several the one that comes first in `--list-models`.
const Model& best_fit(const sim::Lidar& lidar);

/// "0.02 to 30 m instead of 0.12 to 3.5 m, 1081 steps instead of 360"; empty if there are none.
std::string differences(const Model& model, const sim::Lidar& lidar);

}  // namespace scipd::daemon
