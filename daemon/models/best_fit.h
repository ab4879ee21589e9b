// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds the product that comes closest to a lidar in a world or in a recording. Any thread;
// nothing shared.
#pragma once

#include <string>

#include "daemon/models/model.h"
#include "sim/world/lidar.h"

namespace scipd::daemon {

/// Distance of the product from the lidar in field of view, range, step and rate; 0 means equal.
/// A figure that is off by a factor of e adds its weight: 4 for a field of view that is too narrow
/// and 1 for one that is too wide, 2 for the farthest range, 1 for the angle between two steps, 0.8
/// for the rate, 0.1 for the nearest range. Figures that the world's file leaves open add 0. A
/// product has two farthest ranges: the one that its data sheet guarantees and the one that it
/// reports (DMAX). The closer one counts.
double misfit(const Model& model, const sim::Lidar& lidar);

/// The product with the least misfit; of several the one that comes first in `--list-models`.
const Model& best_fit(const sim::Lidar& lidar);

/// The model of a recorded lidar: the best fit if it has all of its directions, its range and its
/// steps, or parts of them; else a scanner named `recorded` that speaks as the best fit does, and
/// says in PP what the recording has. Its beams look to the nearest of its steps.
Model recorded_model(const sim::Lidar& lidar);

/// "0.02 to 30 m instead of 0.12 to 3.5 m, 1081 steps instead of 360"; empty if there are none.
std::string differences(const Model& model, const sim::Lidar& lidar);

}  // namespace scipd::daemon
