// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is kept of one measurement, whoever makes it: a scanner or a sensor that stares. What was
// said of it is added by them. A value; any thread.
#pragma once

#include <memory>

#include "daemon/world/backend_choice.h"
#include "sim/sensor/scan.h"
#include "sim/sensor/sensor_spec.h"
#include "sim/time.h"
#include "sim/world/scene.h"

namespace scipd::daemon {

struct Measurement {
    sim::SharedScan cast;    ///< of all beams
    sim::SharedScene scene;  ///< what its ids mean: the one that it was cast into, without shapes
    SharedChoice backend;    ///< what cast it
    std::shared_ptr<const sim::SensorSpec> optics;  ///< what it was read with
    sim::Time origin{};                             ///< what people call world time 0 (Clock)

    /// A world time as people call it.
    [[nodiscard]] sim::Time told(sim::Time time) const { return origin + time; }
};

}  // namespace scipd::daemon
