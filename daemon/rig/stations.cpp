// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/rig/stations.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "daemon/device/device.h"
#include "daemon/device/staring_sensor.h"
#include "daemon/faults/fault_injector.h"
#include "daemon/link/port.h"
#include "daemon/shards/shard.h"
#include "daemon/wire/wire_tap.h"
#include "protocol/ideal.h"
#include "sim/fnv1a.h"
#include "sim/random.h"

namespace scipd::daemon {
namespace {

/// Another world may have a named mount elsewhere; a sensor that has moved with it is the same.
/// But for what can change while its clients go on.
bool is_same(const SensorConfig& a, const SensorConfig& b) {
    SensorConfig other = a;
    if (!a.staring) set_errors(other, errors_of(b));
    if (a.mount) other.robot_from_sensor = b.robot_from_sensor;
    return other == b;
}

/// Real scanners are switched on at any moment. If all mirrors passed step 0 at once, all scans
/// would have to be cast at once.
sim::Time phase_of(const Station& station, const StationContext& context) {
    const sim::Time period = station.config.model.optics.scan_period;
    if (station.config.clock.phase) return *station.config.clock.phase % period;
    if (context.lockstep) return sim::Time::zero();
    const sim::Chance chance({.seed = station.seed,
                              .sensor = sim::fnv1a<std::uint64_t>(station.name()),
                              .purpose = sim::Purpose::mirror_phase});
    return std::chrono::duration_cast<sim::Time>(0.5 * (1.0 + chance.even(0)) * period);
}

template <class Sensor>
Sensor& put_in(Station& station, const StationContext& context, const SensorConfig& config) {
    auto sensor = std::make_unique<Sensor>(station.robot, config, station.seed, context.shard.world,
                                           context.shard.clock);
    station.loop = std::make_unique<ScanLoop>(*sensor, context.shard.clock, context.shard.number);
    station.tap = std::make_unique<ScanStream::Tap>(context.stream, station.name(), *sensor);
    station.view_tap = std::make_unique<ViewStream::Tap>(context.view, station.name(), *sensor);
    Sensor& there = *sensor;
    station.sensor = std::move(sensor);
    return there;
}

}  // namespace

Station::Station() = default;
Station::~Station() = default;

void Station::mount(const sim::Pose& robot_from_sensor) {
    std::visit([&](const auto& there) { there->mount(robot_from_sensor); }, sensor);
}

void Station::read_as(const ReadingErrors& errors) {
    const auto* const device = std::get_if<std::unique_ptr<Device>>(&sensor);
    if (device == nullptr || errors_of(config) == errors) return;
    set_errors(config, errors);
    (*device)->read_as(config);
}

void Station::retire() {
    if (faults) faults->stop_all();
    for (const auto& port : {ports.tcp, ports.pty}) {
        if (!port) continue;
        port->end_connection();
        port->set_watch(nullptr);
    }
}

std::unique_ptr<Station> make_station(const StationContext& context, const std::string& robot,
                                      const SensorConfig& sensor, std::uint64_t seed,
                                      SensorPorts ports) {
    auto station = std::make_unique<Station>();
    station->robot = robot;
    station->config = sensor;
    station->seed = seed;
    station->shard = context.shard.number;
    station->ports = std::move(ports);
    if (sensor.staring) {
        put_in<StaringSensor>(*station, context, sensor);
        return station;
    }
    SensorConfig of_device = sensor;
    // Time that stands still would never come to the tick of a reply.
    if (context.lockstep)
        of_device.model.profile = protocol::answering_at_once(of_device.model.profile);
    of_device.clock.phase = phase_of(*station, context);
    auto& device = put_in<Device>(*station, context, of_device);
    device.count_clients_in(context.clients);
    if (context.track.tape) device.play(context.track, *sensor.replay);
    std::vector<Port*> served;
    std::vector<std::shared_ptr<Port>> heard;
    for (const auto& port : {station->ports.tcp, station->ports.pty}) {
        if (!port) continue;
        port->set_watch(&device.client_watch());
        served.push_back(port.get());
        heard.push_back(port);
    }
    station->wire_tap = std::make_unique<WireStream::Tap>(
        context.wire, station->name(),
        std::make_unique<WireTap>(device, std::move(heard), wire_log(station->name())));
    station->recordings_tap =
        std::make_unique<Recordings::Tap>(context.recordings, station->name(), device);
    for (Port* const port : served)
        port->serve(device, sensor.link);
    station->served_before = station->ports.counts();
    station->faults = std::make_unique<FaultInjector>(device, std::move(served), sensor.link,
                                                      context.shard.clock);
    station->tap->follow(station->faults->log());
    return station;
}

Station* find_station(const Stations& stations, const std::string& sensor) {
    const auto found = std::ranges::find_if(
        stations, [&](const auto& station) { return station->name() == sensor; });
    return found == stations.end() ? nullptr : found->get();
}

Config as_it_reads(Config config, const Stations& stations) {
    for (RobotConfig& robot : config.robots) {
        for (SensorConfig& sensor : robot.sensors) {
            const auto* const station =
                find_station(stations, sensor_name(robot.name, sensor.name));
            if (station != nullptr && !station->config.staring)
                set_errors(sensor, errors_of(station->config));
        }
    }
    return config;
}

Stations::const_iterator find_unchanged(const Stations& stations, const std::string& robot,
                                        const SensorConfig& sensor, std::uint64_t seed) {
    return std::ranges::find_if(stations, [&](const auto& station) {
        return station->robot == robot && station->seed == seed && is_same(station->config, sensor);
    });
}

std::unique_ptr<Station> take_unchanged(Stations& stations, const std::string& robot,
                                        const SensorConfig& sensor, std::uint64_t seed) {
    const auto found = find_unchanged(stations, robot, sensor, seed);
    if (found == stations.end()) return nullptr;
    auto station = std::move(stations[static_cast<std::size_t>(found - stations.begin())]);
    stations.erase(found);
    return station;
}

}  // namespace scipd::daemon
