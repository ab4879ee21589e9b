// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What comes back to the sensor from one beam: the light of all faces in its footprint that lie too
// close behind each other to be told apart. A value; any thread.
#pragma once

#include "sim/backends/fan.h"

namespace scipd::sim {

struct Echo {
    float range_m = 0.0F;  ///< the mean of its faces, by the light that they send
    /// The light relative to that of a white matt face which is met head-on and fills the beam at
    /// the same range.
    float power = 0.0F;
    float spread_m = 0.0F;  ///< the standard deviation of the ranges of its faces, by their light
    /// What has the face that sends most; no_object: something in the air.
    ObjectId object = no_object;
    MaterialId material = 0;
};

}  // namespace scipd::sim
