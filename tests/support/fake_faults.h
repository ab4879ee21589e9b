// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Faults of one scanner, rescue/front, that are kept but never act. Tests fill the log.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "daemon/faults/fault_kind.h"
#include "tests/support/empty_api.h"

namespace scipd::tests {

class FakeFaults : public EmptyFaults {
  public:
    [[nodiscard]] std::vector<std::string> scanners() const override { return {"rescue/front"}; }

    daemon::FaultStarted start(const std::string&, daemon::FaultPlan plan) override {
        ++last_id;
        faults[last_id] = {.id = last_id,
                           .kind = std::string(plan.kind->name),
                           .state = "waiting",
                           .said = plan.said};
        return {last_id, notes};
    }
    bool stop(const std::string&, std::uint64_t id) override { return faults.erase(id) > 0; }
    void stop_all(const std::string&) override { faults.clear(); }
    [[nodiscard]] std::vector<daemon::FaultStatus> list(const std::string&) const override {
        std::vector<daemon::FaultStatus> list;
        for (const auto& [id, fault] : faults)
            list.push_back(fault);
        return list;
    }
    [[nodiscard]] daemon::FaultLog::Entries log(const std::string&) const override {
        return entries.entries();
    }

    void run(daemon::Scenario scenario) override { running = std::move(scenario); }
    void stop_scenario() override { running->steps.clear(); }
    [[nodiscard]] std::optional<daemon::ScenarioStatus> scenario() const override {
        if (!running) return std::nullopt;
        daemon::ScenarioStatus status{.name = running->name,
                                      .state = running->steps.empty() ? "ended" : "running"};
        for (const auto& [sensor, plan] : running->steps) {
            const auto step = static_cast<int>(status.steps.size()) + 1;
            status.steps.push_back({.step = step,
                                    .sensor = "rescue/front",
                                    .fault = {.id = 10 + static_cast<std::uint64_t>(step),
                                              .kind = std::string(plan.kind->name),
                                              .state = "active",
                                              .hits = 3}});
        }
        return status;
    }

    std::map<std::uint64_t, daemon::FaultStatus> faults;
    std::uint64_t last_id = 0;
    std::vector<std::string> notes;
    daemon::FaultLog entries;
    std::optional<daemon::Scenario> running;
};

}  // namespace scipd::tests
