// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The scenario that is under way, over all scanners of a daemon. There is one at a time. Lives on
// the I/O thread.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "daemon/faults/fault_injector.h"
#include "daemon/faults/scenario.h"

namespace scipd::daemon {

struct ScenarioStepStatus {
    int step = 0;  ///< from 1
    std::string sensor;
    FaultStatus fault;
};

struct ScenarioStatus {
    std::string name;
    std::string state;  ///< "running"; "ended" once no fault of it waits or acts
    std::vector<ScenarioStepStatus> steps;
};

class ScenarioRun {
  public:
    struct Target {
        std::string sensor;
        FaultInjector* injector = nullptr;
        /// Calls it on the scanner's own thread: where a fault begins or ends, it may cast.
        std::function<void(const std::function<void()>&)> there = [](const auto& act) { act(); };
    };

    /// Asks for all faults of the scenario, in the place of those of the one before.
    void run(Scenario scenario, const std::vector<Target>& targets);
    /// Its faults end.
    void stop(const std::vector<Target>& targets);
    /// A scanner has come: it gets its faults as well, unless they have been stopped.
    void join(const Target& target) const;
    /// Nothing: none was run.
    [[nodiscard]] std::optional<ScenarioStatus> status(const std::vector<Target>& targets) const;

  private:
    std::optional<Scenario> scenario_;
    bool stopped_ = false;
};

}  // namespace scipd::daemon
