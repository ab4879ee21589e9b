// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The curves of a sensor's optics, made once and asked for each beam of each scan. Constant; any
// thread.
#pragma once

#include "sim/sensor/curve.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::sim {

struct SpecCurves {
    explicit SpecCurves(const SensorSpec& spec);

    Curve bias;             ///< by range
    Curve white_wall;       ///< the deviation by range, of such a wall head-on
    Curve intensity;        ///< by range, of the same wall
    Curve intensity_noise;  ///< by intensity, as a share of it
    double faintest_intensity;
};

}  // namespace scipd::sim
