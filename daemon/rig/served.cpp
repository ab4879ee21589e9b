// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/rig/served.h"

#include <cstddef>
#include <string>
#include <vector>

#include "daemon/link/port.h"
#include "daemon/rig/simulation.h"

namespace scipd::daemon {
namespace {

/// A line of many is read by nobody.
constexpr std::size_t most_named = 4;

std::string named(const Station& station) {
    std::string text = station.name();
    const char* before = " on ";
    for (const Port* port : {station.ports.tcp.get(), station.ports.pty.get()}) {
        if (!port) continue;
        text += before + port->address();
        before = " and ";
    }
    return text;
}

std::string status_line(const Simulation& simulation) {
    const std::size_t count = simulation.stations.size();
    std::string line = std::to_string(count) + (count == 1 ? " sensor" : " sensors") + " in " +
                       simulation.editor.file().filename().string();
    for (std::size_t i = 0; i < count && i < most_named; ++i)
        line += (i == 0 ? ": " : ", ") + named(*simulation.stations[i]);
    if (count > most_named) line += " and " + std::to_string(count - most_named) + " more";
    return line;
}

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
    return {[&] { return simulation.shards.still([&] { return status_line(simulation); }); },
            [&] { return simulation.shards.still([&] { return looks_at(simulation.stations); }); }};
}

}  // namespace scipd::daemon
