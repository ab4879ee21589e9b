// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/rig/served.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "daemon/rig/report.h"
#include "daemon/rig/simulation.h"

namespace scipd::daemon {
namespace {

/// A line of many is read by nobody.
constexpr std::size_t most_named = 4;

std::string named(const SensorReport& sensor) {
    std::string text = sensor.name;
    const char* before = " on ";
    for (const auto& place : {sensor.tcp, sensor.pty}) {
        if (!place) continue;
        text += before + *place;
        before = " and ";
    }
    return text;
}

std::string status_line(const RigReport& rig) {
    const std::size_t count = rig.sensors.size();
    std::string line = std::to_string(count) + (count == 1 ? " sensor" : " sensors");
    const std::filesystem::path scene(rig.scene);
    if (!scene.empty()) line += " in " + scene.filename().string();
    for (std::size_t i = 0; i < count && i < most_named; ++i)
        line += (i == 0 ? ": " : ", ") + named(rig.sensors[i]);
    if (count > most_named) line += " and " + std::to_string(count - most_named) + " more";
    return line;
}

// Not from a report: the watchdog looks often, and at nothing else.
std::vector<ScanWatch::Look> looks_at(const Stations& stations) {
    std::vector<ScanWatch::Look> loops;
    for (const auto& station : stations) {
        const ScanLoop& loop = *station->loop;
        loops.push_back({station->name(), loop.turn(), loop.overdue()});
    }
    return loops;
}

}  // namespace

Served served(Simulation& simulation) {
    return {
        [&] { return status_line(simulation.shards.still([&] { return report_of(simulation); })); },
        [&] { return simulation.shards.still([&] { return looks_at(simulation.stations); }); }};
}

}  // namespace scipd::daemon
