// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/service_status.h"

#include <cstddef>
#include <filesystem>

#include "daemon/api/api.h"

namespace scipd::daemon {
namespace {

/// A line of many is read by nobody.
constexpr std::size_t most_named = 4;

std::string named(const SensorStatus& sensor) {
    std::string text = sensor.name;
    const char* before = " on ";
    for (const auto& address : {sensor.tcp, sensor.pty}) {
        if (!address) continue;
        text += before + *address;
        before = " and ";
    }
    return text;
}

}  // namespace

std::string status_line(const FleetStatus& status) {
    const std::size_t count = status.sensors.size();
    std::string line = std::to_string(count) + (count == 1 ? " sensor" : " sensors") + " in " +
                       std::filesystem::path{status.scene}.filename().string();
    for (std::size_t i = 0; i < count && i < most_named; ++i)
        line += (i == 0 ? ": " : ", ") + named(status.sensors[i]);
    if (count > most_named) line += " and " + std::to_string(count - most_named) + " more";
    return line;
}

}  // namespace scipd::daemon
