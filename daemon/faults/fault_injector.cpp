// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/faults/fault_injector.h"

#include <algorithm>
#include <utility>

#include "daemon/faults/fault_kind.h"

namespace scipd::daemon {

struct FaultInjector::Run {
    std::uint64_t id = 0;
    FaultPlan plan;
    std::optional<int> step;
};

FaultInjector::FaultInjector(Device& device, std::vector<Port*> ports, const LinkConfig& link,
                             Clock& clock)
    : device_(device), ports_(std::move(ports)), link_(link), clock_(clock) {}

FaultInjector::~FaultInjector() {
    stop_all();
}

std::uint64_t FaultInjector::start(FaultPlan plan, std::uint64_t /*seed*/,
                                   std::optional<int> step) {
    runs_.push_back(std::make_unique<Run>(Run{++last_id_, std::move(plan), step}));
    return last_id_;
}

bool FaultInjector::stop(std::uint64_t id) {
    return std::erase_if(runs_, [&](const auto& run) { return run->id == id; }) > 0;
}

void FaultInjector::stop_all() {
    runs_.clear();
}

std::vector<FaultStatus> FaultInjector::list() const {
    std::vector<FaultStatus> list;
    for (const auto& run : runs_) {
        list.push_back({.id = run->id,
                        .kind = std::string(run->plan.kind->name),
                        .state = "waiting",
                        .said = run->plan.said,
                        .scenario_step = run->step});
    }
    return list;
}

}  // namespace scipd::daemon
