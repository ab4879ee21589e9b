// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/rig/rig_faults.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>

#include "daemon/device/device.h"
#include "daemon/faults/fault_injector.h"
#include "daemon/rig/simulation.h"

namespace scipd::daemon {

void RigFaults::at(const std::string& scanner, const std::function<void(Station&)>& act) const {
    Station& station = *find_station(simulation_.stations, scanner);
    simulation_.shards.still_on(station.shard, [&] { act(station); });
}

std::vector<std::string> RigFaults::scanners() const {
    std::vector<std::string> names;
    for (const auto& target : simulation_.scanners())
        names.push_back(target.sensor);
    return names;
}

std::vector<std::string> RigFaults::notes_on(const Station& scanner, const FaultPlan& plan) const {
    const auto* const scan = std::get_if<AtScan>(&plan.start);
    const auto* const time = std::get_if<AtTime>(&plan.start);
    const Device& device = *std::get<std::unique_ptr<Device>>(scanner.sensor);
    if (scan != nullptr && scan->scan < device.next_revolution())
        return {"at.scan has passed, so the fault begins at once"};
    if (time != nullptr && time->told < simulation_.clock.origin() + simulation_.clock.now())
        return {"at.time_s has passed, so the fault begins at once"};
    return {};
}

FaultStarted RigFaults::start(const std::string& scanner, FaultPlan plan) {
    FaultStarted started;
    at(scanner, [&](Station& station) {
        started.notes = notes_on(station, plan);
        started.id = station.faults->start(std::move(plan), station.seed);
    });
    return started;
}

bool RigFaults::stop(const std::string& scanner, std::uint64_t id) {
    bool stopped = false;
    at(scanner, [&](Station& station) { stopped = station.faults->stop(id); });
    return stopped;
}

void RigFaults::stop_all(const std::string& scanner) {
    at(scanner, [](Station& station) { station.faults->stop_all(); });
}

std::vector<FaultStatus> RigFaults::list(const std::string& scanner) const {
    std::vector<FaultStatus> list;
    at(scanner, [&](Station& station) { list = station.faults->list(); });
    return list;
}

FaultLog::Entries RigFaults::log(const std::string& scanner) const {
    FaultLog::Entries entries;
    at(scanner, [&](Station& station) { entries = station.faults->log().entries(); });
    return entries;
}

void RigFaults::run(Scenario scenario) {
    simulation_.shards.still(
        [&] { simulation_.scenario.run(std::move(scenario), simulation_.scanners()); });
}

void RigFaults::stop_scenario() {
    simulation_.shards.still([&] { simulation_.scenario.stop(simulation_.scanners()); });
}

std::optional<ScenarioStatus> RigFaults::scenario() const {
    return simulation_.shards.still(
        [&] { return simulation_.scenario.status(simulation_.scanners()); });
}

}  // namespace scipd::daemon
