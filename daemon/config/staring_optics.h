// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads the optics of a sensor that speaks no SCIP: `camera` or `ranger` in place of `model`. One
// thread at a time.
#pragma once

#include "sim/loaders/yaml/yaml_section.h"
#include "sim/sensor/staring.h"

namespace scipd::daemon {

sim::StaringSpec read_camera(const sim::YamlField& field, sim::YamlFaults& faults);
sim::StaringSpec read_ranger(const sim::YamlField& field, sim::YamlFaults& faults);

/// Keys of a scanner's wire are faults here.
void refuse_wire(const sim::YamlSection& sensor, sim::YamlFaults& faults);

}  // namespace scipd::daemon
