// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/rig/status_report.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>

#include "daemon/device/device.h"
#include "daemon/device/staring_sensor.h"
#include "daemon/link/port.h"
#include "daemon/rig/simulation.h"

namespace scipd::daemon {
namespace {

std::string state_of(const Device& device) {
    const protocol::DeviceState& state = device.state();
    if (state.booting(device.uptime())) return "booting";
    if (state.failed()) return "error";
    if (state.asleep()) return "asleep";
    if (state.adjusting()) return "time adjust";
    if (state.streaming()) return "streaming";
    return state.laser_on() ? "measuring" : "standby";
}

std::optional<LatenessStatus> summary_of(const Lateness& lateness) {
    if (!lateness.max()) return std::nullopt;
    LatenessStatus status{*lateness.quantile(0.5), *lateness.quantile(0.99), *lateness.max()};
    std::uint64_t before = 0;
    for (std::size_t i = 0; i < lateness_octaves.size(); ++i) {
        const std::uint64_t below = lateness.below(lateness_octaves[i]);
        status.counts[i] = below - std::exchange(before, below);
    }
    status.counts.back() = lateness.count() - before;
    return status;
}

std::map<std::string, std::uint64_t> casts_of(const SensorCounts& counts) {
    std::map<std::string, std::uint64_t> casts;
    for (const auto& [backend, count] : counts.casts)
        casts[backend] = count.casts;
    return casts;
}

void describe(const Device& device, SensorStatus& status) {
    status.model = device.profile().name;
    status.state = state_of(device);
    status.scans = device.scans_sent();
    status.lateness = summary_of(device.lateness());
    status.casts = casts_of(device.counts());
}

void describe(const StaringSensor& sensor, SensorStatus& status) {
    status.model = sensor.spec().kind();
    status.state = sensor.wanted() ? "measuring" : "standby";
    status.scans = sensor.measured();
    status.lateness = summary_of(sensor.lateness());
    status.casts = casts_of(sensor.counts());
}

void add(const Port& port, std::optional<std::string>& address, SensorStatus& status) {
    address = port.address();
    status.clients += port.connected() ? 1 : 0;
}

SensorStatus status_of(const Station& station, const Simulation& simulation) {
    const BackendChoice& choice = *simulation.world.choice_of(station.name());
    SensorStatus status{
        .name = station.name(),
        .backend = choice.backend,
        .backend_reason = choice.reason.empty() ? std::optional<std::string>() : choice.reason,
        .warning = simulation.place_watch.warning(station.name()),
        .lost = station.loop->missed() + station.ports.counts().lost_scans -
                station.served_before.lost_scans,
        .stream_lost = station.loop->missed_by_watchers() + station.tap->lost()};
    std::visit([&](const auto& sensor) { describe(*sensor, status); }, station.sensor);
    if (!station.config.staring) status.errors = errors_of(station.config);
    if (station.ports.tcp) add(*station.ports.tcp, status.tcp, status);
    if (station.ports.pty) add(*station.ports.pty, status.pty, status);
    return status;
}

}  // namespace

RigStatus status_of(const Simulation& simulation) {
    RigStatus status{.uptime = simulation.wall_clock.now(),
                     .clock = simulation.lockstep ? "poses" : "wall",
                     .time = simulation.clock.origin() + simulation.clock.now(),
                     .scene = simulation.editor.file(),
                     .warnings = simulation.editor.warnings()};
    const PoseIntake& intake = simulation.intake;
    status.poses = {intake.accepted(), intake.refused(), intake.last_refusal()};
    for (const auto& station : simulation.stations)
        status.sensors.push_back(status_of(*station, simulation));
    return status;
}

}  // namespace scipd::daemon
