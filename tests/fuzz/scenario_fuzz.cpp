// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as a scenario: parse_scenario() returns steps that can be asked for singly as well, or
// faults that can be shown. The same bytes as a single fault: parse_fault() never throws.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "daemon/faults/scenario.h"
#include "sim/loaders/file/load_error.h"

namespace {

using namespace scipd::daemon;

void require(bool holds) {
    if (!holds) std::abort();
}

void check(const FaultPlan& plan) {
    require(plan.kind != nullptr && plan.make() != nullptr);
    const auto again = parse_fault(plan.said);
    // A scenario may be longer than what the control API takes.
    if (plan.said.size() > 8192) return;
    require(again.has_value());
    require(again->kind == plan.kind && again->start == plan.start && again->end == plan.end);
    require(again->every == plan.every && again->seed == plan.seed && again->said == plan.said);
}

void check(const Scenario& scenario) {
    require(!scenario.steps.empty() && scenario.steps.size() <= 1000);
    for (const ScenarioStep& step : scenario.steps) {
        require(step.sensor == "*" || step.sensor == "rescue/front");
        check(step.fault);
    }
}

void check(const scipd::sim::LoadError& error) {
    require(!error.faults().empty());
    for (const auto& fault : error.faults()) {
        require(fault.starts_with("bad_day.yaml:"));
        require(fault.find('\n') == fault.npos);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text{reinterpret_cast<const char*>(data), size};
    try {
        check(parse_scenario(text, "bad_day.yaml", std::vector<std::string>{"rescue/front"}));
    } catch (const scipd::sim::LoadError& error) {
        check(error);
    }
    if (const auto plan = parse_fault(text)) check(*plan);
    return 0;
}
