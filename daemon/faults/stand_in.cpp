// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// TO BE DELETED AT THE MERGE. Reads and runs faults as little as the control API needs, until
// read_fault.cpp, scenario.cpp and scenario_run.cpp are there: three kinds, no schedule.
#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>
#include <yaml-cpp/yaml.h>

#include "daemon/config/config_error.h"
#include "daemon/faults/fault_kind.h"
#include "daemon/faults/read_fault.h"
#include "daemon/faults/scenario_run.h"

namespace scipd::daemon {
namespace {

constexpr auto no_keys = [] { return std::vector<std::string_view>{}; };
constexpr std::array<FaultKind, 3> stand_ins{{
    {"stall", "link", "", false, no_keys, nullptr},
    {"corrupt", "link", "", false, no_keys, nullptr},
    {"reboot", "device", "", true, no_keys, nullptr},
}};

sim::Expected<FaultPlan> plan_of(const std::string& kind, std::string said) {
    const auto* const row = std::ranges::find(stand_ins, kind, &FaultKind::name);
    if (row == stand_ins.end()) return sim::refuse("kind", "must be a kind, not '" + kind + "'");
    FaultPlan plan;
    plan.kind = row;
    plan.said = std::move(said);
    plan.make = [] { return std::make_unique<FaultEffect>(); };
    return plan;
}

}  // namespace

sim::Expected<FaultPlan> parse_fault(const std::string& json) {
    const auto object = nlohmann::ordered_json::parse(json, nullptr, false);
    if (!object.is_object()) return sim::refuse("must be a JSON object");
    if (!object.contains("kind")) return sim::refuse("kind", "is missing");
    if (object.contains("for") && !object["for"].is_object())
        return sim::refuse("for", "must be {scans: N} or {s: T}");
    auto plan = plan_of(object["kind"], object.dump());
    if (plan && object.contains("at") && object["at"].contains("scan"))
        plan->start = AtScan{object["at"]["scan"]};
    if (plan && object.contains("at") && object["at"].contains("time_s"))
        plan->start = AtTime{std::chrono::seconds(object["at"]["time_s"])};
    return plan;
}

Scenario parse_scenario(const std::string& text, const std::string& name,
                        const std::vector<std::string>& sensors) {
    Scenario scenario{.name = name};
    std::vector<std::string> faults;
    for (const YAML::Node& step : YAML::Load(text)["steps"]) {
        const std::string place = name + ":" + std::to_string(step.Mark().line + 1) + ": steps.";
        const auto kind = step["kind"].as<std::string>();
        const auto sensor = step["sensor"].as<std::string>();
        auto plan = plan_of(kind, R"({"kind":")" + kind + R"("})");
        if (!plan) faults.push_back(place + "kind: " + plan.error().why);
        if (sensor != "*" && std::ranges::find(sensors, sensor) == sensors.end())
            faults.push_back(place + "sensor: must be a sensor");
        if (faults.empty()) scenario.steps.push_back({sensor, *std::move(plan)});
    }
    if (!faults.empty()) throw ConfigError(faults);
    return scenario;
}

void ScenarioRun::run(Scenario scenario, const std::vector<Target>& targets) {
    stop(targets);
    int number = 0;
    for (const auto& [sensor, fault] : scenario.steps) {
        ++number;
        for (const Target& target : targets) {
            if (sensor == "*" || sensor == target.sensor)
                (void)target.injector->start(fault, 1, number);
        }
    }
    scenario_ = std::move(scenario);
}

void ScenarioRun::stop(const std::vector<Target>& targets) {
    for (const Target& target : targets) {
        for (const FaultStatus& fault : target.injector->list()) {
            if (fault.scenario_step) (void)target.injector->stop(fault.id);
        }
    }
}

std::optional<ScenarioStatus> ScenarioRun::status(const std::vector<Target>& targets) const {
    if (!scenario_) return std::nullopt;
    ScenarioStatus status{.name = scenario_->name, .state = "running"};
    for (const Target& target : targets) {
        for (const FaultStatus& fault : target.injector->list()) {
            if (fault.scenario_step)
                status.steps.push_back({*fault.scenario_step, target.sensor, fault});
        }
    }
    if (status.steps.empty()) status.state = "ended";
    return status;
}

}  // namespace scipd::daemon
