// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One measurement of a sensor with what the sensor made of it: a scanner the words of the wire, a
// camera or ranger its ranges. Values; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "daemon/device/bridge.h"
#include "daemon/device/measurement.h"
#include "sim/sensor/error_model.h"
#include "sim/sensor/staring.h"

namespace scipd::daemon {

/// Effect of a fault on the readings of a scan.
struct ReadingFault {
    std::string kind;
    std::string what;        ///< for people, as in the log of faults
    std::vector<int> steps;  ///< the changed steps, ascending; empty: the whole scan
};

struct ScanRecord : Measurement {
    WireScan sent;
    std::vector<ReadingFault> faults;
    sim::Accuracy accuracy = sim::Accuracy::sensor;  ///< of the scanner
    std::uint32_t stamp_ms = 0;                      ///< the time that the wire gave it
    int front_step = 0;
    int steps_per_turn = 0;
};

/// What a camera or ranger measured. Its revolution is the number of the measurement, its start the
/// instant that it was made for.
struct StaringRecord : Measurement {
    std::vector<float> range_m;  ///< what the sensor says; infinity: nothing
    sim::StaringSpec spec;       ///< of the sensor
};

}  // namespace scipd::daemon
