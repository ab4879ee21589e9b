// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the control API asks about faults, of a running rig. Lives on the I/O thread.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "daemon/api/faults_api.h"

namespace scipd::daemon {

struct Simulation;
struct Station;

class RigFaults : public FaultsApi {
  public:
    /// `simulation` must outlive it.
    explicit RigFaults(Simulation& simulation) : simulation_(simulation) {}

    [[nodiscard]] std::vector<std::string> scanners() const override;
    FaultStarted start(const std::string& scanner, FaultPlan plan) override;
    bool stop(const std::string& scanner, std::uint64_t id) override;
    void stop_all(const std::string& scanner) override;
    [[nodiscard]] std::vector<FaultStatus> list(const std::string& scanner) const override;
    [[nodiscard]] FaultLog::Entries log(const std::string& scanner) const override;
    void run(Scenario scenario) override;
    void stop_scenario() override;
    [[nodiscard]] std::optional<ScenarioStatus> scenario() const override;

  private:
    /// Calls `act` on the scanner's own thread: where a fault begins or ends, it may cast.
    void at(const std::string& scanner, const std::function<void(Station&)>& act) const;
    [[nodiscard]] std::vector<std::string> notes_on(const Station& scanner,
                                                    const FaultPlan& plan) const;

    Simulation& simulation_;
};

}  // namespace scipd::daemon
