// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/service_status.h"

#include <cstddef>

#include "daemon/link/port.h"
#include "daemon/simulation.h"

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

}  // namespace

std::string status_line(const Simulation& simulation) {
    const std::size_t count = simulation.stations.size();
    std::string line = std::to_string(count) + (count == 1 ? " sensor" : " sensors") + " in " +
                       simulation.editor.file().filename().string();
    for (std::size_t i = 0; i < count && i < most_named; ++i)
        line += (i == 0 ? ": " : ", ") + named(*simulation.stations[i]);
    if (count > most_named) line += " and " + std::to_string(count - most_named) + " more";
    return line;
}

}  // namespace scipd::daemon
