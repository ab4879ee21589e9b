// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/homes.h"

#include <algorithm>
#include <chrono>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <vector>

#include "daemon/config/config.h"
#include "daemon/config/run_directory.h"
#include "daemon/plan/known_sensors.h"
#include "daemon/shards/burdens.h"

namespace scipd::daemon {
namespace {

/// One sensor of a configuration.
struct Lodger {
    std::string name;
    const SensorConfig* config;
    PortKeys ports;
};

std::vector<Lodger> lodgers_of(const Config& config) {
    std::vector<Lodger> lodgers;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors) {
            lodgers.push_back(
                {sensor_name(robot.name, sensor.name), &sensor, port_keys(robot.name, sensor)});
        }
    }
    return lodgers;
}

std::optional<std::size_t> held(const Lodger& lodger, const Homes& now) {
    for (const auto& [places, key] :
         {std::pair{&now.ports, &lodger.ports.pty}, std::pair{&now.ports, &lodger.ports.tcp},
          std::pair{&now.sensors, &lodger.name}}) {
        const auto found = places->find(*key);
        if (found != places->end()) return found->second;
    }
    return std::nullopt;
}

/// What a sensor costs while it measures, as a share of a core.
class Costs {
  public:
    Costs(const std::vector<Lodger>& lodgers, const KnownSensors& known) : known_(known) {
        double rays = 0.0;
        Seconds spent{};
        for (const Lodger& lodger : lodgers) {
            const auto sweep = measured(lodger);
            if (!sweep) continue;
            rays += rays_of(*lodger.config);
            spent += *sweep;
        }
        if (rays > 0.0) ray_ = spent / rays;
    }

    [[nodiscard]] double of(const Lodger& lodger) const {
        const SensorConfig& sensor = *lodger.config;
        const Seconds period =
            sensor.staring ? sensor.staring->period : sensor.model.optics.scan_period;
        return measured(lodger).value_or(rays_of(sensor) * ray_) / period;
    }

  private:
    using Seconds = std::chrono::duration<double>;

    [[nodiscard]] std::optional<Seconds> measured(const Lodger& lodger) const {
        const KnownSensor* const known = find_known(known_, lodger.name, *lodger.config);
        return known != nullptr ? known->sweep : std::nullopt;
    }

    static double rays_of(const SensorConfig& sensor) {
        if (sensor.staring) return sensor.staring->beams();
        const sim::SensorSpec& optics = sensor.model.optics;
        return optics.beams() * (sensor.sees_light() ? optics.footprint.rays : 1);
    }

    const KnownSensors& known_;
    Seconds ray_{30e-9};  ///< about that; where nothing is measured, only shares matter
};

/// Who is disturbed by another scanner looks at it while it turns.
bool live_together(const std::vector<Lodger>& lodgers) {
    return std::ranges::any_of(lodgers,
                               [](const Lodger& lodger) { return lodger.config->interference; });
}

}  // namespace

Homes find_homes(const Config& config, const Homes& now, const KnownSensors& known) {
    const std::vector<Lodger> lodgers = lodgers_of(config);
    const Costs costs(lodgers, known);
    const bool together = live_together(lodgers);
    std::vector<Burden> burdens;
    for (const Lodger& lodger : lodgers)
        burdens.push_back({costs.of(lodger), held(lodger, now)});
    const auto is_elsewhere = [](const Burden& burden) { return burden.held > 0; };
    if (together && std::ranges::any_of(burdens, is_elsewhere)) {
        throw std::runtime_error(
            "interference: scanners that disturb each other live on one thread, and these live on "
            "several by now; start scipd again for that");
    }
    const auto shard_of = spread(burdens, together ? 1 : now.shards);
    Homes next{.shards = now.shards};
    for (std::size_t i = 0; i < lodgers.size(); ++i) {
        next.sensors[lodgers[i].name] = shard_of[i];
        for (const std::string& key : {lodgers[i].ports.tcp, lodgers[i].ports.pty}) {
            if (!key.empty()) next.ports[key] = shard_of[i];
        }
    }
    return next;
}

// If the system chooses the port, two scanners with the same address have ports of their own.
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
