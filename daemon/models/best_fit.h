// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds the product that comes closest to a lidar in a world or in a recording. Any thread;
// nothing shared.
#pragma once

#include <string>

#include "daemon/models/model.h"
#include "sim/recording/values/recorded_scan.h"
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

/// The product that has a text as its model, or whose name is in it, such as UTM-30LX in "SOKUIKI
/// Sensor TOP-URG UTM-30LX(Hokuyo ...)": the longest name, and of several such products the one
/// with this firmware or else the first. Null: none.
const Model* model_named_in(const std::string& text, const std::string& firmware = {});

/// A recorded fan. The recording has its angles.
sim::Lidar recorded_lidar(const sim::Directions& directions, std::size_t steps,
                          const sim::ScannerIdentity& identity, double rate_hz);

/// The model of a recorded lidar: the best fit if it has all of its directions, its range and its
/// steps, or parts of them; else a scanner named `recorded` that speaks as the best fit does, and
/// says in PP what the recording has. Its beams look to the nearest of its steps.
Model recorded_model(const sim::Lidar& lidar);
/// Directions, steps and range of a recorded lidar that the best fit does not have, as
/// differences() reports them. Empty: recorded_model() is the best fit.
std::string missing_in_best_fit(const sim::Lidar& lidar);

/// "0.02 to 30 m instead of 0.12 to 3.5 m, 1081 steps instead of 360"; empty if there are none.
std::string differences(const Model& model, const sim::Lidar& lidar);

}  // namespace scipd::daemon
