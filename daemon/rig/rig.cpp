// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/rig/rig.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include <spdlog/spdlog.h>

#include "daemon/config/poses.h"
#include "daemon/faults/fault_injector.h"
#include "daemon/link/port.h"
#include "daemon/plan/load_world.h"
#include "daemon/plan/rig_plan.h"
#include "daemon/poses/pose_feed.h"
#include "daemon/rig/report.h"
#include "daemon/rig/simulation.h"
#include "daemon/service/logging.h"

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

/// Gazebo tells of the models of a world by a topic that has the world's name.
void name_topic(PoseSource& source, const RigPlan& plan) {
    if (source.kind != PoseSource::Kind::gz || !source.topic.empty()) return;
    if (!plan.loaded.scene || plan.loaded.scene->name.empty())
        throw std::runtime_error("poses from gz: need a world that has a name; say gz:/TOPIC");
    source.topic = "/world/" + plan.loaded.scene->name + "/dynamic_pose/info";
}

PoseNeeds pose_needs(const Config& config, const RobotConfig& robot) {
    PoseNeeds needs{.policy = pose_policy(config, robot)};
    for (const SensorConfig& sensor : robot.sensors) {
        if (sensor.staring || sensor.replay) continue;
        needs.wait = sensor.wait_for_poses;
        needs.sweep = std::min<sim::Time>(needs.sweep, sensor.model.profile.scan_period);
    }
    return needs;
}

/// Those that the configuration still has.
Stations take_unchanged(Stations& old, const Config& config) {
    Stations kept;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors) {
            auto station = take_unchanged(old, robot.name, sensor, config.seed);
            if (station) kept.push_back(std::move(station));
        }
    }
    return kept;
}

std::vector<std::string> names_of_sensors(const Config& config) {
    std::vector<std::string> names;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors)
            names.push_back(sensor_name(robot.name, sensor.name));
    }
    return names;
}

/// Where the world goes on, `told` has what was said of it before.
void log_findings(const RigPlan& plan, const std::vector<std::string>& told) {
    const auto is_new = [&](const std::string& warning) {
        return !plan.world_goes_on || std::ranges::find(told, warning) == told.end();
    };
    for (const auto* warnings : {&plan.loaded.warnings, &plan.trajectories.warnings}) {
        for (const std::string& warning : *warnings)
            if (is_new(warning)) spdlog::warn("{}", warning);
    }
    for (const std::string& notice : plan.notices)
        spdlog::info("{}", notice);
}

}  // namespace

/// Which robot's poses come from where.
struct Rig::Feed {
    std::string robot;
    PoseSource source;
    std::shared_ptr<PoseFeed> feed;
    PoseNeeds needs;
};

Rig::Rig(const boost::asio::any_io_executor& executor, ClockKind clock, const HandedSockets* handed,
         std::size_t shards)
    : executor_(executor),
      handed_(handed),
      simulation_(std::make_unique<Simulation>(executor, clock, shards)),
      homes_{.shards = simulation_->shards.size()} {}

Rig::~Rig() {
    stop();
}

void Rig::apply(const Config& config) {
    apply(make_plan(config, {.homes = homes_, .played = running().played}));
}

std::chrono::nanoseconds Rig::apply(RigPlan&& plan) {
    return simulation_->shards.still([&] {
        const auto begin = std::chrono::steady_clock::now();
        Ports ports = prepare_ports(plan.config, plan.homes);
        Feeds feeds = open_feeds(plan);
        take_up(std::move(plan), std::move(ports), std::move(feeds));
        return std::chrono::steady_clock::now() - begin;
    });
}

// An exception on the way would leave ports behind that serve devices which are gone.
void Rig::take_up(RigPlan&& plan, Ports ports, Feeds feeds) noexcept {
    const Config& config = plan.config;
    tell_log_of(names_of_sensors(config));
    log_findings(plan, simulation_->editor.warnings());
    retire(config, ports);
    replace_world(plan);
    homes_ = std::move(plan.homes);
    const std::vector<Station*> fresh = start(plan, ports);
    (void)simulation_->remount();
    ports_ = std::move(ports);
    replace_feeds(std::move(feeds));
    replace_scenario(plan, fresh);
}

// A fault that ends may have its scanner answer what clients have asked: it casts once more. The
// ports may soon be those of other scanners, to which no fault of these must do anything.
void Rig::retire(const Config& config, const Ports& ports) noexcept {
    Simulation& simulation = *simulation_;
    Stations staying = take_unchanged(simulation.stations, config);
    Stations leaving = std::exchange(simulation.stations, std::move(staying));
    for (const auto& station : leaving)
        simulation.shards.still_on(station->shard, [&] { station->retire(); });
    keep_counts(leaving, simulation);
    stop_unneeded(ports_, ports);
}

void Rig::replace_world(RigPlan& plan) noexcept {
    Simulation& simulation = *simulation_;
    if (!plan.world_goes_on) begin_world(plan);
    simulation.editor.add_warnings(plan.loaded.warnings);
    simulation.worker.discard(std::make_shared<SensorBackends>(
        simulation.world.replace_scene(std::move(plan.loaded.scene), std::move(plan.backends), {},
                                       simulation.clock.now() - plan.scripts_age)));
    std::map<std::string, RobotStart> robots;
    for (const RobotConfig& robot : plan.config.robots)
        robots[robot.name] = {robot.world_from_robot, pose_policy(plan.config, robot), robot.body};
    simulation.world.set_robots(robots);
}

void Rig::begin_world(RigPlan& plan) noexcept {
    Simulation& simulation = *simulation_;
    const Config& config = plan.config;
    simulation.limits->set(config.client_limits);
    simulation.editor.set_file(config.scene, scene_options(config, plan.materials), config.allow,
                               std::move(plan.added));
    simulation.world.set_materials(plan.materials);
    simulation.world.configure_media(config.media);
}

void Rig::stop() {
    simulation_->chooser.stop();
    simulation_->worker.stop();
    simulation_->drawer.stop();
    simulation_->shards.still([&] {
        replace_feeds({});
        retire({}, {});
        ports_ = {};
    });
    simulation_->shards.join();
}

Ports Rig::prepare_ports(const Config& config, const Homes& homes) const {
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

Rig::Feeds Rig::open_feeds(const RigPlan& plan) {
    const FeedContext context{
        .executor = executor_,
        .intake = simulation_->intake,
        .clock = simulation_->clock,
        .lockstep = simulation_->lockstep.get(),
        .report = [](const std::string& message) { spdlog::warn("{}", message); }};
    Feeds feeds;
    for (RobotConfig robot : plan.config.robots) {
        // Vehicles come by the broker of the world that is shared.
        if (!robot.poses || robot.poses->kind == PoseSource::Kind::vda5050) continue;
        name_topic(*robot.poses, plan);
        const PoseNeeds needs = pose_needs(plan.config, robot);
        const auto open = std::ranges::find_if(
            feeds_, [&](const Feed& feed) { return can_serve(feed.robot, feed.source, robot); });
        if (open != feeds_.end()) {
            feeds.push_back({robot.name, *robot.poses, open->feed, needs});
            continue;
        }
        const auto read = plan.trajectories.poses.find(robot.name);
        const bool plays = read != plan.trajectories.poses.end();
        feeds.push_back({robot.name, *robot.poses,
                         make_feed(context, *robot.poses, plays ? read->second : nullptr), needs});
    }
    return feeds;
}

std::vector<Station*> Rig::start(const RigPlan& plan, const Ports& ports) noexcept {
    Simulation& simulation = *simulation_;
    const Config& config = plan.config;
    Stations staying = std::exchange(simulation.stations, {});
    std::vector<Station*> fresh;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors) {
            auto station = take_unchanged(staying, robot.name, sensor, config.seed);
            const std::string name = sensor_name(robot.name, sensor.name);
            const std::size_t home = homes_.sensors.at(name);
            const auto track = plan.tracks.find(name);
            const StationContext context{
                .shard = simulation.shards.at(home),
                .stream = simulation.stream,
                .view = simulation.view,
                .wire = simulation.wire,
                .recordings = simulation.recordings,
                .clients = simulation.clients,
                .lockstep = simulation.lockstep != nullptr,
                .track = track == plan.tracks.end() ? Track{} : track->second};
            SensorPorts served = ports_of(ports, robot.name, sensor);
            if (!station) {
                station = make_station(context, robot.name, sensor, config.seed, served);
                fresh.push_back(station.get());
            } else if (!plan.world_goes_on) {
                station->read_as(errors_of(sensor));
            }
            simulation.stations.push_back(std::move(station));
        }
    }
    return fresh;
}

void Rig::replace_scenario(RigPlan& plan, const std::vector<Station*>& fresh) noexcept {
    ScenarioRun& run = simulation_->scenario;
    std::optional<Scenario>& scenario = plan.scenario;
    if (plan.world_goes_on || scenario == scenario_) {
        for (const Station* const station : fresh) {
            if (station->faults) run.join(simulation_->target_of(*station));
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

Running Rig::running() const {
    Running running{.sensors = simulation_->known_sensors(), .homes = homes_, .played = {}};
    for (const Feed& feed : feeds_) {
        if (feed.source.kind == PoseSource::Kind::file) running.played[feed.robot] = feed.source;
    }
    return running;
}

std::map<std::string, Address> Rig::pose_addresses() const {
    std::map<std::string, Address> addresses;
    for (const Feed& feed : feeds_) {
        if (const auto address = feed.feed->address()) addresses[feed.robot] = *address;
    }
    return addresses;
}

void Rig::replace_feeds(Feeds feeds) noexcept {
    const auto in = [](const Feeds& list, const Feed& feed) {
        return std::ranges::any_of(list,
                                   [&](const Feed& other) { return other.feed == feed.feed; });
    };
    for (const Feed& old : feeds_) {
        if (!in(feeds, old)) old.feed->stop();
    }
    simulation_->feeds.clear();
    std::set<std::string> sources;
    for (const Feed& feed : feeds) {
        feed.feed->move_models(sources.insert(text_of(feed.source)).second);
        feed.feed->serve(feed.robot, feed.needs);
        simulation_->feeds.push_back(feed.feed);
    }
    feeds_ = std::move(feeds);
}

}  // namespace scipd::daemon
