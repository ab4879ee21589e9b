// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/port_keys.h"

#include "daemon/config/config.h"
#include "daemon/config/run_directory.h"

namespace scipd::daemon {

// Where the system chooses the port, two scanners with the same address have ports of their own.
PortKeys port_keys(const std::string& robot, const SensorConfig& sensor) {
    PortKeys keys;
    if (sensor.tcp) {
        keys.tcp = "tcp " + text_of(*sensor.tcp);
        if (sensor.tcp->port == 0) keys.tcp += " of " + sensor_name(robot, sensor.name);
    }
    if (sensor.pty) keys.pty = "pty " + link_of(robot, sensor).string();
    return keys;
}

std::filesystem::path link_of(const std::string& robot, const SensorConfig& sensor) {
    const bool is_auto = sensor.pty->link.empty();
    return is_auto ? run_directory() / tty_name(robot, sensor.name) : sensor.pty->link;
}

}  // namespace scipd::daemon
