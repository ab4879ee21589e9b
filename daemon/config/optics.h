// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a user may say of a model's errors and of its light, beside the fields of its profile: the
// members of sim::SensorSpec that do not follow from the profile. Any thread; nothing shared.
#pragma once

#include <string_view>
#include <vector>

#include "sim/loaders/yaml/yaml_section.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::daemon {

std::vector<std::string_view> optics_keys();

/// Reads `none`, `unit` or a curve: what a scanner reads too far. True: a curve, or none.
bool read_bias_choice(const sim::YamlField& field, sim::SensorSpec& optics,
                      sim::YamlFaults& faults);

/// Replaces what the section gives.
void override_optics(const sim::YamlSection& section, sim::SensorSpec& optics,
                     sim::YamlFaults& faults);

}  // namespace scipd::daemon
