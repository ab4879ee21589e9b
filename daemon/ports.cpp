// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/ports.h"

#include <filesystem>
#include <optional>
#include <utility>

#include <spdlog/spdlog.h>
#include <unistd.h>

#include "daemon/config/config.h"
#include "daemon/config/run_directory.h"
#include "daemon/handed_sockets.h"
#include "daemon/link/pty_port.h"
#include "daemon/link/tcp_port.h"

namespace scipd::daemon {
namespace {

std::filesystem::path link_of(const std::string& robot, const SensorConfig& sensor) {
    const bool is_auto = sensor.pty->link.empty();
    return is_auto ? run_directory() / tty_name(robot, sensor.name) : sensor.pty->link;
}

// Where the system chooses the port, two scanners with the same address have ports of their own.
std::string tcp_key(const std::string& robot, const SensorConfig& sensor) {
    const std::string key = "tcp " + text_of(*sensor.tcp);
    return sensor.tcp->port != 0 ? key : key + " of " + sensor_name(robot, sensor.name);
}

std::string pty_key(const std::string& robot, const SensorConfig& sensor) {
    return "pty " + link_of(robot, sensor).string();
}

// The first scipd has the ttys that nobody has named; those started after it make their own.
std::shared_ptr<Port> open_tty(const boost::asio::any_io_executor& executor,
                               const std::string& robot, const SensorConfig& sensor) {
    std::filesystem::path link = link_of(robot, sensor);
    if (!sensor.pty->link.empty()) return std::make_shared<PtyPort>(executor, link);
    make_run_directory();
    try {
        return std::make_shared<PtyPort>(executor, link);
    } catch (const PathHeld&) {
        link += "-" + std::to_string(::getpid());
        return std::make_shared<PtyPort>(executor, link);
    }
}

// SCIP has no passwords.
std::shared_ptr<Port> open_tcp(const boost::asio::any_io_executor& executor,
                               const std::string& robot, const SensorConfig& sensor,
                               const HandedSockets* handed) {
    auto port = std::make_shared<TcpPort>(executor, *sensor.tcp,
                                          handed ? handed->at(*sensor.tcp) : std::nullopt);
    if (!is_loopback(*sensor.tcp)) {
        spdlog::warn("{} listens on {}: everybody who reaches this machine can use it",
                     sensor_name(robot, sensor.name), port->address());
    }
    return port;
}

template <class Open>
std::shared_ptr<Port> open_or_else(const Ports& ports, const std::string& key, Open open) {
    const auto found = ports.find(key);
    return found != ports.end() ? found->second : open();
}

}  // namespace

LinkCounts SensorPorts::counts() const {
    LinkCounts counts;
    for (const auto& port : {tcp, pty}) {
        if (port) counts += port->counts();
    }
    return counts;
}

Ports open_ports(const boost::asio::any_io_executor& executor, const Config& config,
                 const Ports& open, const HandedSockets* handed) {
    Ports ports;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors) {
            if (sensor.tcp) {
                const std::string key = tcp_key(robot.name, sensor);
                ports[key] = open_or_else(
                    open, key, [&] { return open_tcp(executor, robot.name, sensor, handed); });
            }
            if (sensor.pty) {
                const std::string key = pty_key(robot.name, sensor);
                ports[key] =
                    open_or_else(open, key, [&] { return open_tty(executor, robot.name, sensor); });
            }
        }
    }
    return ports;
}

SensorPorts ports_of(const Ports& ports, const std::string& robot, const SensorConfig& sensor) {
    return {.tcp = sensor.tcp ? ports.at(tcp_key(robot, sensor)) : nullptr,
            .pty = sensor.pty ? ports.at(pty_key(robot, sensor)) : nullptr};
}

void stop_unneeded(const Ports& open, const Ports& needed) {
    for (const auto& [key, port] : open) {
        if (!needed.contains(key)) port->stop();
    }
}

}  // namespace scipd::daemon
