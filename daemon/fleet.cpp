// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet.h"

#include <algorithm>
#include <utility>

#include <spdlog/spdlog.h>

#include "daemon/faults/fault_injector.h"
#include "daemon/fleet_metrics.h"
#include "daemon/fleet_plan.h"
#include "daemon/link/port.h"
#include "daemon/link/tcp_port.h"
#include "daemon/load_world.h"
#include "daemon/logging.h"
#include "daemon/poses/pose_feed.h"
#include "daemon/simulation.h"

namespace scipd::daemon {
namespace {

/// Whether what serves the one robot will do for the other: a port or the standard input can change
/// hands. A trajectory is played by each robot anew, and a port that the system chooses stays with
/// its robot.
bool can_serve(const std::string& robot, const PoseSource& source, const RobotConfig& other) {
    const bool changes_hands = source.kind == PoseSource::Kind::standard_input ||
                               (source.kind == PoseSource::Kind::udp && source.address.port != 0);
    return source == *other.poses && (changes_hands || robot == other.name);
}

/// Those that the configuration still has, in its order; null for the others.
Stations take_unchanged(Stations& old, const Config& config) {
    Stations kept;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors)
            kept.push_back(take_unchanged(old, robot.name, sensor, config.seed));
    }
    return kept;
}

void end_faults(const Stations& stations) {
    for (const auto& station : stations) {
        if (station->faults) station->faults->stop_all();
    }
}

std::vector<std::string> names_of_sensors(const Config& config) {
    std::vector<std::string> names;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors)
            names.push_back(sensor_name(robot.name, sensor.name));
    }
    return names;
}

void log_findings(const FleetPlan& plan) {
    for (const std::string& warning : plan.loaded.warnings)
        spdlog::warn("{}", warning);
    for (const auto* notes : {&plan.loaded.notes, &plan.notices}) {
        for (const std::string& note : *notes)
            spdlog::info("{}", note);
    }
}

}  // namespace

/// Which robot's poses come from where.
struct Fleet::Feed {
    std::string robot;
    PoseSource source;
    std::shared_ptr<PoseFeed> feed;
};

Fleet::Fleet(const boost::asio::any_io_executor& executor, ClockKind clock,
             const HandedSockets* handed, std::size_t shards)
    : executor_(executor),
      handed_(handed),
      simulation_(std::make_unique<Simulation>(executor, clock, shards)),
      homes_{.shards = simulation_->shards.size()} {}

Fleet::~Fleet() {
    stop();
}

void Fleet::apply(const Config& config) {
    // Of a sensor of which nothing is known, none moves.
    (void)apply(make_plan(config, {}, {}, homes_));
}

bool Fleet::apply(FleetPlan&& plan) {
    return simulation_->shards.still([&] {
        const std::vector<std::string>& moved = plan.homes.moved;
        if (std::ranges::any_of(moved, [&](const std::string& sensor) {
                const Station* const station = find_station(simulation_->stations, sensor);
                return station != nullptr && in_use(*station);
            }))
            return false;
        Ports ports;
        try {
            ports = prepare_ports(plan.config, plan.homes);
        } catch (const PortNotMoved&) {
            if (moved.empty()) throw;
            return false;
        }
        Feeds feeds = open_feeds(plan.config);
        take_up(std::move(plan), std::move(ports), std::move(feeds));
        return true;
    });
}

// An exception on the way would leave ports behind that serve devices which are gone.
void Fleet::take_up(FleetPlan&& plan, Ports ports, Feeds feeds) noexcept {
    tell_log_of(names_of_sensors(plan.config));
    log_findings(plan);
    Simulation& simulation = *simulation_;
    const Config& config = plan.config;
    simulation.limits->set(config.client_limits);
    simulation.editor.set_file(config.scene, scene_options(config, plan.materials), config.allow,
                               std::move(plan.added));
    simulation.editor.set_warnings(std::move(plan.loaded.warnings));
    simulation.world.set_materials(plan.materials);
    simulation.world.configure_media(config.media);
    simulation.worker.discard(std::make_shared<SensorBackends>(
        simulation.world.replace_scene(std::move(plan.loaded.scene), std::move(plan.backends), {},
                                       simulation.clock.now() - plan.scripts_age)));
    std::map<std::string, RobotStart> robots;
    for (const RobotConfig& robot : config.robots)
        robots[robot.name] = {robot.world_from_robot, robot.policy, robot.body};
    simulation.world.set_robots(robots);
    homes_ = std::move(plan.homes);
    const std::vector<Station*> fresh = replace_stations(config, ports);
    (void)simulation.remount();
    ports_ = std::move(ports);
    replace_feeds(std::move(feeds));
    replace_scenario(std::move(plan.scenario), fresh);
}

void Fleet::stop() {
    simulation_->worker.stop();
    simulation_->drawer.stop();
    simulation_->shards.still([&] {
        replace_feeds({});
        (void)replace_stations({}, {});
        ports_ = {};
    });
    simulation_->shards.join();
}

Ports Fleet::prepare_ports(const Config& config, const Homes& homes) const {
    Ports ports = open_ports({simulation_->shards, homes_, homes, handed_}, config, ports_);
    for (const auto& [key, port] : ports)
        port->hold_to(simulation_->limits);
    const Stations& stations = simulation_->stations;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors) {
            if (find_unchanged(stations, robot.name, sensor, config.seed) != stations.end())
                continue;
            const auto [tcp, pty] = ports_of(ports, robot.name, sensor);
            if (tcp) tcp->prepare();
            if (pty) pty->prepare();
        }
    }
    return ports;
}

Fleet::Feeds Fleet::open_feeds(const Config& config) {
    const FeedContext context{
        .executor = executor_,
        .intake = simulation_->intake,
        .clock = simulation_->clock,
        .lockstep = simulation_->lockstep.get(),
        .strict = config.strict,
        .report = [](const std::string& message) { spdlog::warn("{}", message); }};
    Feeds feeds;
    for (const RobotConfig& robot : config.robots) {
        // Vehicles come by the broker of the world that is shared.
        if (!robot.poses || robot.poses->kind == PoseSource::Kind::vda5050) continue;
        const auto open = std::ranges::find_if(
            feeds_, [&](const Feed& feed) { return can_serve(feed.robot, feed.source, robot); });
        feeds.push_back({robot.name, *robot.poses,
                         open != feeds_.end() ? open->feed : make_feed(context, *robot.poses)});
    }
    return feeds;
}

std::vector<Station*> Fleet::replace_stations(const Config& config, const Ports& ports) noexcept {
    Stations& old = simulation_->stations;
    Stations stations = take_unchanged(old, config);
    // Their ports may soon be those of other scanners, to which no fault of theirs must do
    // anything.
    end_faults(old);
    keep_counts(old, *simulation_);
    std::vector<Station*> fresh;
    Stations left;
    auto place = stations.begin();
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors) {
            std::unique_ptr<Station>& station = *place++;
            const std::size_t home = homes_.sensors.at(sensor_name(robot.name, sensor.name));
            if (station && station->shard == home) continue;
            const StationContext context{.shard = simulation_->shards.at(home),
                                         .stream = simulation_->stream,
                                         .view = simulation_->view,
                                         .wire = simulation_->wire,
                                         .lockstep = simulation_->lockstep != nullptr};
            SensorPorts served = ports_of(ports, robot.name, sensor);
            if (station) {
                left.push_back(std::exchange(station, moved(*station, context, served)));
            } else {
                station = make_station(context, robot.name, sensor, config.seed, served);
                fresh.push_back(station.get());
            }
        }
    }
    stations.swap(old);
    // A port that a new device has taken over serves that one already. The others go here, before
    // the devices behind them.
    stop_unneeded(ports_, ports);
    return fresh;
}

void Fleet::replace_scenario(std::optional<Scenario> scenario,
                             const std::vector<Station*>& fresh) noexcept {
    ScenarioRun& run = simulation_->scenario;
    if (scenario == scenario_) {
        for (const Station* const station : fresh) {
            if (station->faults) run.join({station->name(), station->faults.get()});
        }
        return;
    }
    if (scenario) {
        run.run(*scenario, simulation_->scanners());
    } else {
        run.stop(simulation_->scanners());
    }
    scenario_ = std::move(scenario);
}

std::map<std::string, Address> Fleet::pose_addresses() const {
    std::map<std::string, Address> addresses;
    for (const Feed& feed : feeds_) {
        if (const auto address = feed.feed->address()) addresses[feed.robot] = *address;
    }
    return addresses;
}

void Fleet::replace_feeds(Feeds feeds) noexcept {
    const auto in = [](const Feeds& list, const Feed& feed) {
        return std::ranges::any_of(list,
                                   [&](const Feed& other) { return other.feed == feed.feed; });
    };
    for (const Feed& old : feeds_) {
        if (!in(feeds, old)) old.feed->stop();
    }
    for (const Feed& feed : feeds)
        feed.feed->serve(feed.robot);
    feeds_ = std::move(feeds);
}

}  // namespace scipd::daemon
