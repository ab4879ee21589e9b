// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the control API asks about faults on purpose. On the I/O thread; only handlers call it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "daemon/faults/fault_log.h"
#include "daemon/faults/fault_plan.h"
#include "daemon/faults/scenario.h"
#include "daemon/faults/scenario_run.h"

namespace scipd::daemon {

struct FaultStarted {
    std::uint64_t id = 0;
    std::vector<std::string> notes;  ///< what is worth knowing about it
};

/// A `scanner` is one of scanners().
class FaultsApi {
  public:
    virtual ~FaultsApi() = default;

    /// The sensors that faults can be asked for: those that speak SCIP.
    [[nodiscard]] virtual std::vector<std::string> scanners() const = 0;

    virtual FaultStarted start(const std::string& scanner, FaultPlan plan) = 0;
    /// Ends a fault and forgets it. False: there is none of this id.
    virtual bool stop(const std::string& scanner, std::uint64_t id) = 0;
    virtual void stop_all(const std::string& scanner) = 0;
    [[nodiscard]] virtual std::vector<FaultStatus> list(const std::string& scanner) const = 0;
    /// All that are kept, the oldest first.
    [[nodiscard]] virtual FaultLog::Entries log(const std::string& scanner) const = 0;

    /// It takes the place of the scenario before.
    virtual void run(Scenario scenario) = 0;
    virtual void stop_scenario() = 0;
    /// Nothing: none was run.
    [[nodiscard]] virtual std::optional<ScenarioStatus> scenario() const = 0;
};

}  // namespace scipd::daemon
