// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A YAML file of faults that belong together: which sensor, what, when. Checked values; any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "daemon/faults/fault_plan.h"
#include "daemon/faults/read_fault.h"

namespace scipd::daemon {

struct ScenarioStep {
    std::string sensor;  ///< "rescue/front", or "*" for all
    FaultPlan fault;

    [[nodiscard]] bool goes_wrong_at(const std::string& name) const {
        return sensor == "*" || sensor == name;
    }
};

struct Scenario {
    std::string name;  ///< of its file
    std::uint64_t seed = 1;
    std::vector<ScenarioStep> steps;

    /// Whether the other is of a file of the same name and asks for the same.
    bool operator==(const Scenario& other) const;
};

/// `name` stands before each fault of the text: "FILE:LINE: KEY: sentence", where the third step is
/// "steps.3". `sensors` are the scanners that there are; nothing: any name will do. Throws
/// sim::LoadError with all faults.
Scenario parse_scenario(const std::string& text, const std::string& name,
                        const std::optional<std::vector<std::string>>& sensors,
                        const FaultKinds& kinds = fault_kinds());
/// Reads a file, which may be missing or too long, as parse_scenario() does a text.
Scenario load_scenario(const std::filesystem::path& file,
                       const std::optional<std::vector<std::string>>& sensors,
                       const FaultKinds& kinds = fault_kinds());

}  // namespace scipd::daemon
