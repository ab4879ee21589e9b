// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How a fleet is doing.
#include <string>

#include "daemon/fleet.h"

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
    return LatenessStatus{*lateness.quantile(0.5), *lateness.quantile(0.99), *lateness.max()};
}

void describe(const Device& device, SensorStatus& status) {
    status.model = device.profile().name;
    status.state = state_of(device);
    status.scans = device.scans_sent();
    status.lateness = summary_of(device.lateness());
}

void describe(const StaringSensor& sensor, SensorStatus& status) {
    status.model = sensor.spec().kind();
    status.state = sensor.wanted() ? "measuring" : "standby";
    status.scans = sensor.measured();
    status.lateness = summary_of(sensor.lateness());
}

}  // namespace

Status Fleet::status() const {
    Status status{.uptime = wall_clock_.now(),
                  .clock = lockstep_ ? "poses" : "wall",
                  .time = clock_.origin() + clock_.now(),
                  .scene = editor_.file()};
    status.poses = {intake_.accepted(), intake_.refused(), intake_.last_refusal()};
    for (const auto& station : stations_)
        status.sensors.push_back(status_of(*station));
    return status;
}

SensorStatus Fleet::status_of(const Station& station) const {
    const BackendChoice& choice = *world_.choice_of(station.name());
    SensorStatus status{
        .name = station.name(),
        .backend = choice.backend,
        .backend_reason = choice.reason.empty() ? std::optional<std::string>() : choice.reason,
        .warning = place_watch_.warning(station.name()),
        .lost = station.loop->missed(),
        .stream_lost = station.loop->missed_by_watchers() + station.tap->lost()};
    station.staring ? describe(*station.staring, status) : describe(*station.device, status);
    if (station.tcp) {
        status.tcp = station.tcp->address();
        status.clients += station.tcp->connected() ? 1 : 0;
        status.lost += station.tcp->lost_scans();
    }
    if (station.pty) {
        status.pty = station.pty->address();
        status.clients += station.pty->connected() ? 1 : 0;
        status.lost += station.pty->lost_scans();
    }
    return status;
}

}  // namespace scipd::daemon
