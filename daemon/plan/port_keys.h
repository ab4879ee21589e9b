// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the ports of a sensor are called by, as long as they stay. A value; any thread.
#pragma once

#include <filesystem>
#include <string>

namespace scipd::daemon {

struct SensorConfig;

/// The keys of one sensor; empty where it has no port of the kind.
struct PortKeys {
    std::string tcp;
    std::string pty;
};
[[nodiscard]] PortKeys port_keys(const std::string& robot, const SensorConfig& sensor);

/// The link of the sensor's tty, which it has.
[[nodiscard]] std::filesystem::path link_of(const std::string& robot, const SensorConfig& sensor);

}  // namespace scipd::daemon
