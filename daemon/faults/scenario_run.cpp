// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/faults/scenario_run.h"

#include <algorithm>
#include <utility>

#include "sim/fnv1a.h"

namespace scipd::daemon {
namespace {

/// A seed for the step, equal in every run.
std::uint64_t seed_of_step(const Scenario& scenario, int number) {
    return sim::fnv1a<std::uint64_t>(std::to_string(scenario.seed) + " step " +
                                     std::to_string(number));
}

}  // namespace

void ScenarioRun::run(Scenario scenario, const std::vector<Target>& targets) {
    stop(targets);
    scenario_ = std::move(scenario);
    stopped_ = false;
    for (const Target& target : targets)
        join(target);
}

void ScenarioRun::stop(const std::vector<Target>& targets) {
    stopped_ = true;
    for (const Target& target : targets) {
        target.there([&] {
            for (const FaultStatus& fault : target.injector->list()) {
                if (fault.scenario_step) target.injector->stop(fault.id);
            }
        });
    }
}

void ScenarioRun::join(const Target& target) const {
    if (!scenario_ || stopped_) return;
    target.there([&] {
        int number = 0;
        for (const ScenarioStep& step : scenario_->steps) {
            ++number;
            if (!step.goes_wrong_at(target.sensor)) continue;
            target.injector->start(step.fault, seed_of_step(*scenario_, number), number);
        }
    });
}

std::optional<ScenarioStatus> ScenarioRun::status(const std::vector<Target>& targets) const {
    if (!scenario_) return std::nullopt;
    ScenarioStatus status{.name = scenario_->name, .state = "ended", .steps = {}};
    for (const Target& target : targets) {
        for (FaultStatus& fault : target.injector->list()) {
            if (!fault.scenario_step) continue;
            if (fault.state != "ended") status.state = "running";
            status.steps.push_back({*fault.scenario_step, target.sensor, std::move(fault)});
        }
    }
    std::ranges::stable_sort(status.steps, {}, &ScenarioStepStatus::step);
    return status;
}

}  // namespace scipd::daemon
