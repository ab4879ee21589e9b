// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The fields of a model as a user writes them, under a sensor's `profile:` or in a model of the
// file's own: members of protocol::DeviceProfile by their names, `noise`, and the errors and light
// of sim::SensorSpec that do not follow from that. Any thread; nothing shared.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "daemon/models/model.h"
#include "sim/loaders/yaml/yaml_section.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::daemon {

/// All members except name and release, which say what model it is.
std::vector<std::string_view> profile_keys();
/// The keys of `codes` and of `scip1`.
std::vector<std::string_view> code_keys();
std::vector<std::string_view> scip1_keys();

/// A map that may have the fields of a profile and the keys `besides`.
sim::YamlSection profile_section(const sim::YamlField& map,
                                 std::span<const std::string_view> besides,
                                 sim::YamlFaults& faults);

/// Replaces what the section gives in the model, and derives the optics anew. Then it checks that
/// all members of the profile go together. Without a model it only checks each value by itself.
void override_model(const sim::YamlSection& section, const sim::YamlField& map,
                    std::optional<Model>& model, sim::YamlFaults& faults);

std::vector<std::string_view> optics_keys();

/// Reads `none`, `unit` or a curve: what a scanner reads too far. True: a curve, or none.
bool read_bias_choice(const sim::YamlField& field, sim::SensorSpec& optics,
                      sim::YamlFaults& faults);

/// Replaces what the section gives.
void override_optics(const sim::YamlSection& section, sim::SensorSpec& optics,
                     sim::YamlFaults& faults);

}  // namespace scipd::daemon
