// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet_faults.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>

#include "daemon/device/device.h"
#include "daemon/faults/fault_injector.h"
#include "daemon/simulation.h"

namespace scipd::daemon {

FaultInjector& FleetFaults::injector(const std::string& scanner) const {
    return *find_station(simulation_.stations, scanner)->faults;
}

std::vector<std::string> FleetFaults::scanners() const {
    std::vector<std::string> names;
    for (const auto& target : simulation_.scanners())
        names.push_back(target.sensor);
    return names;
}

std::vector<std::string> FleetFaults::notes_on(const std::string& scanner,
                                               const FaultPlan& plan) const {
    const auto& sensor = find_station(simulation_.stations, scanner)->sensor;
    const auto* const scan = std::get_if<AtScan>(&plan.start);
    const auto* const time = std::get_if<AtTime>(&plan.start);
    if (scan != nullptr &&
        scan->scan < std::get<std::unique_ptr<Device>>(sensor)->next_revolution())
        return {"at.scan has passed, so the fault begins at once"};
    if (time != nullptr && time->told < simulation_.clock.origin() + simulation_.clock.now())
        return {"at.time_s has passed, so the fault begins at once"};
    return {};
}

FaultStarted FleetFaults::start(const std::string& scanner, FaultPlan plan) {
    return simulation_.shards.still([&] {
        FaultStarted started{.notes = notes_on(scanner, plan)};
        const Station& station = *find_station(simulation_.stations, scanner);
        started.id = station.faults->start(std::move(plan), station.seed);
        return started;
    });
}

bool FleetFaults::stop(const std::string& scanner, std::uint64_t id) {
    return simulation_.shards.still([&] { return injector(scanner).stop(id); });
}

void FleetFaults::stop_all(const std::string& scanner) {
    simulation_.shards.still([&] { injector(scanner).stop_all(); });
}

std::vector<FaultStatus> FleetFaults::list(const std::string& scanner) const {
    return simulation_.shards.still([&] { return injector(scanner).list(); });
}

FaultLog::Entries FleetFaults::log(const std::string& scanner) const {
    return simulation_.shards.still([&] { return injector(scanner).log().entries(); });
}

void FleetFaults::run(Scenario scenario) {
    simulation_.shards.still(
        [&] { simulation_.scenario.run(std::move(scenario), simulation_.scanners()); });
}

void FleetFaults::stop_scenario() {
    simulation_.shards.still([&] { simulation_.scenario.stop(simulation_.scanners()); });
}

std::optional<ScenarioStatus> FleetFaults::scenario() const {
    return simulation_.shards.still(
        [&] { return simulation_.scenario.status(simulation_.scanners()); });
}

}  // namespace scipd::daemon
