// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/rig/report.h"

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "daemon/device/device.h"
#include "daemon/device/staring_sensor.h"
#include "daemon/faults/fault_injector.h"
#include "daemon/link/port.h"
#include "daemon/rig/simulation.h"

namespace scipd::daemon {
namespace {

std::string model_of(const Device& device) {
    return device.profile().name;
}

std::string model_of(const StaringSensor& sensor) {
    return std::string(sensor.spec().kind());
}

std::string state_of(const Device& device) {
    const protocol::DeviceState& state = device.state();
    if (state.booting(device.uptime())) return "booting";
    if (state.failed()) return "error";
    if (state.asleep()) return "asleep";
    if (state.adjusting()) return "time adjust";
    if (state.streaming()) return "streaming";
    return state.laser_on() ? "measuring" : "standby";
}

std::string state_of(const StaringSensor& sensor) {
    return sensor.wanted() ? "measuring" : "standby";
}

SensorCounts counts_of(const Station& station) {
    SensorCounts counts =
        std::visit([](const auto& sensor) { return sensor->counts(); }, station.sensor);
    const LinkCounts links = station.ports.counts();
    counts.lost = station.loop->missed() + links.lost_scans - station.served_before.lost_scans;
    counts.sent_bytes = links.sent_bytes - station.served_before.sent_bytes;
    if (station.faults) counts.faults = station.faults->log().hits();
    return counts;
}

std::vector<std::string> kinds_that_act(const FaultInjector& faults) {
    std::vector<std::string> kinds;
    for (FaultStatus& fault : faults.list()) {
        if (fault.state == "active") kinds.push_back(std::move(fault.kind));
    }
    return kinds;
}

void add(Port& port, std::optional<std::string>& address, SensorReport& report) {
    address = port.address();
    if (!port.connected()) return;
    ++report.clients;
    report.connected.push_back(port.kind() == protocol::LinkKind::tty ? "tty" : port.client());
}

SensorReport report_of(const Station& station, const Simulation& simulation) {
    const std::string name = station.name();
    const BackendChoice& choice = *simulation.world.choice_of(name);
    SensorReport report{
        .name = name,
        .backend = choice.backend,
        .backend_reason = choice.reason.empty() ? std::optional<std::string>() : choice.reason,
        .warning = simulation.place_watch.warning(name),
        .seed = station.seed,
        .counts = counts_of(station),
        .stream_lost = station.loop->missed_by_watchers() + station.tap->lost()};
    std::visit(
        [&](const auto& sensor) {
            report.model = model_of(*sensor);
            report.state = state_of(*sensor);
        },
        station.sensor);
    if (station.faults) report.faults = kinds_that_act(*station.faults);
    if (!station.config.staring) report.errors = errors_of(station.config);
    if (station.ports.tcp) add(*station.ports.tcp, report.tcp, report);
    if (station.ports.tcp) report.waiting = station.ports.tcp->waiting();
    if (station.ports.pty) add(*station.ports.pty, report.pty, report);
    const auto before = simulation.counted_before.find(name);
    if (before != simulation.counted_before.end()) report.counts_before = before->second;
    return report;
}

}  // namespace

RigReport report_of(const Simulation& simulation) {
    const PoseIntake& intake = simulation.intake;
    RigReport report{.uptime = simulation.wall_clock.now(),
                     .clock = simulation.lockstep ? "poses" : "wall",
                     .time = simulation.clock.origin() + simulation.clock.now(),
                     .scene = simulation.editor.file(),
                     .warnings = simulation.editor.warnings(),
                     .poses = {intake.accepted(), intake.refused(), intake.last_refusal(), {}}};
    for (const auto& feed : simulation.feeds)
        report.poses.sources.push_back(feed->report());
    for (std::size_t i = 0; i < limit_table.size(); ++i) {
        report.limited[std::string(limit_table[i].key)] =
            simulation.limits->refused(static_cast<Limit>(i));
    }
    for (const auto& station : simulation.stations)
        report.sensors.push_back(report_of(*station, simulation));
    return report;
}

void keep_counts(const Stations& leaving, Simulation& simulation) {
    for (const auto& station : leaving)
        simulation.counted_before[station->name()] += counts_of(*station);
}

}  // namespace scipd::daemon
