// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/rig/ports.h"

#include <filesystem>
#include <optional>
#include <utility>

#include <spdlog/spdlog.h>

#include "daemon/config/config.h"
#include "daemon/config/run_directory.h"
#include "daemon/link/pty_port.h"
#include "daemon/link/tcp_port.h"
#include "daemon/plan/homes.h"
#include "daemon/service/handed_sockets.h"
#include "daemon/shards/shards.h"

namespace scipd::daemon {
namespace {

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

void warn_of_strangers(const std::string& sensor, const Address& address, const Port& port) {
    if (is_loopback(address)) return;
    // SCIP has no passwords.
    spdlog::warn("{} listens on {}: every machine that reaches this one can use it", sensor,
                 port.address());
}

/// One sensor's, on its shard.
class Opener {
  public:
    Opener(const PortContext& context, const Ports& open, const std::string& robot,
           const SensorConfig& sensor)
        : context_(context),
          open_(open),
          robot_(robot),
          sensor_(sensor),
          home_(context.next.sensors.at(sensor_name(robot, sensor.name))) {}

    [[nodiscard]] std::shared_ptr<Port> tcp(const std::string& key) const {
        const auto found = open_.find(key);
        if (found != open_.end()) return here(key, found->second);
        const HandedSockets* const handed = context_.handed;
        auto port = std::make_shared<TcpPort>(executor(), *sensor_.tcp,
                                              handed ? handed->at(*sensor_.tcp) : std::nullopt);
        warn_of_strangers(sensor_name(robot_, sensor_.name), *sensor_.tcp, *port);
        return port;
    }

    // A sensor lives where its tty is.
    [[nodiscard]] std::shared_ptr<Port> pty(const std::string& key) const {
        const auto found = open_.find(key);
        return found != open_.end() ? found->second : open_tty(executor(), robot_, sensor_);
    }

  private:
    [[nodiscard]] boost::asio::any_io_executor executor() const {
        return context_.shards.at(home_).executor;
    }
    [[nodiscard]] std::shared_ptr<Port> here(const std::string& key,
                                             const std::shared_ptr<Port>& port) const {
        if (context_.now.ports.at(key) == home_) return port;
        return dynamic_cast<TcpPort&>(*port).moved_to(executor());
    }

    const PortContext& context_;
    const Ports& open_;
    const std::string& robot_;
    const SensorConfig& sensor_;
    std::size_t home_;
};

}  // namespace

LinkCounts SensorPorts::counts() const {
    LinkCounts counts;
    for (const auto& port : {tcp, pty}) {
        if (port) counts += port->counts();
    }
    return counts;
}

Ports open_ports(const PortContext& context, const Config& config, const Ports& open) {
    Ports ports;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors) {
            const Opener opener(context, open, robot.name, sensor);
            const auto [tcp, pty] = port_keys(robot.name, sensor);
            if (!tcp.empty()) ports[tcp] = opener.tcp(tcp);
            if (!pty.empty()) ports[pty] = opener.pty(pty);
        }
    }
    return ports;
}

SensorPorts ports_of(const Ports& ports, const std::string& robot, const SensorConfig& sensor) {
    const auto [tcp, pty] = port_keys(robot, sensor);
    return {.tcp = tcp.empty() ? nullptr : ports.at(tcp),
            .pty = pty.empty() ? nullptr : ports.at(pty)};
}

void stop_unneeded(const Ports& open, const Ports& needed) {
    for (const auto& [key, port] : open) {
        const auto found = needed.find(key);
        if (found == needed.end() || found->second != port) port->stop();
    }
}

}  // namespace scipd::daemon
