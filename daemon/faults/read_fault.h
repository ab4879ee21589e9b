// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads faults that a user asks for: one by the control API, many in the steps of a scenario. Both
// have the same keys and the same sentences. Any thread; nothing shared.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/faults/fault_kind.h"
#include "daemon/faults/fault_plan.h"
#include "sim/expected.h"
#include "sim/loaders/yaml/yaml_section.h"

namespace scipd::daemon {

using FaultKinds = std::vector<const FaultKind*>;

/// A map {kind, at, for, until, every, jitter, seed, the kind's own members}, with `also` as keys
/// that somebody else reads. Nothing: it has faults, and `faults` has them.
std::optional<FaultPlan> read_fault(const sim::YamlField& map,
                                    std::span<const std::string_view> also, sim::YamlFaults& faults,
                                    const FaultKinds& kinds = fault_kinds());

/// Reads a fault from a JSON object; a refusal names the field, such as "for.scans".
sim::Expected<FaultPlan> parse_fault(const std::string& json,
                                     const FaultKinds& kinds = fault_kinds());

}  // namespace scipd::daemon
