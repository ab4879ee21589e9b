// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A YAML file of faults that belong together: which sensor, what, when. Checked values; any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "daemon/faults/fault_plan.h"

namespace scipd::daemon {

struct ScenarioStep {
    std::string sensor;  ///< "rescue/front", or "*" for all
    FaultPlan fault;
};

struct Scenario {
    std::string name;  ///< of its file
    std::uint64_t seed = 1;
    std::vector<ScenarioStep> steps;
};

/// `name` stands before each fault of the text: "FILE:LINE: KEY: sentence". `sensors` are those
/// that there are. Throws ConfigError with all faults.
Scenario parse_scenario(const std::string& text, const std::string& name,
                        const std::vector<std::string>& sensors);
/// The same of a file, which may be missing or too long.
Scenario load_scenario(const std::filesystem::path& file, const std::vector<std::string>& sensors);

}  // namespace scipd::daemon
