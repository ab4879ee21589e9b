// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/rig/metrics_report.h"

#include <variant>

#include "daemon/device/device.h"
#include "daemon/device/staring_sensor.h"
#include "daemon/faults/fault_injector.h"
#include "daemon/link/port.h"
#include "daemon/rig/simulation.h"

namespace scipd::daemon {
namespace {

SensorCounts counts_of(const Station& station) {
    SensorCounts counts =
        std::visit([](const auto& sensor) { return sensor->counts(); }, station.sensor);
    const LinkCounts links = station.ports.counts();
    counts.lost = station.loop->missed() + links.lost_scans - station.served_before.lost_scans;
    counts.sent_bytes = links.sent_bytes - station.served_before.sent_bytes;
    if (station.faults) counts.faults = station.faults->log().hits();
    return counts;
}

SensorMetrics metrics_of(const Station& station, const Simulation& simulation) {
    SensorMetrics metrics{.name = station.name(), .counts = counts_of(station)};
    for (const auto& port : {station.ports.tcp, station.ports.pty})
        metrics.clients += port && port->connected() ? 1 : 0;
    // Whoever computes a rate needs the count before the first cast.
    metrics.counts.casts.try_emplace(simulation.world.choice_of(metrics.name)->backend);
    const auto before = simulation.counted_before.find(metrics.name);
    if (before != simulation.counted_before.end()) metrics.counts += before->second;
    return metrics;
}

}  // namespace

RigMetrics metrics_of(const Simulation& simulation) {
    RigMetrics metrics{.poses = simulation.intake.accepted(),
                       .poses_refused = simulation.intake.refused()};
    for (std::size_t i = 0; i < limit_table.size(); ++i) {
        metrics.limited[std::string(limit_table[i].key)] =
            simulation.limits->refused(static_cast<Limit>(i));
    }
    for (const auto& station : simulation.stations)
        metrics.sensors.push_back(metrics_of(*station, simulation));
    return metrics;
}

void keep_counts(const Stations& leaving, Simulation& simulation) {
    for (const auto& station : leaving) {
        if (station) simulation.counted_before[station->name()] += counts_of(*station);
    }
}

}  // namespace scipd::daemon
