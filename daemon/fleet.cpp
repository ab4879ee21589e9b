// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <spdlog/spdlog.h>
#include <unistd.h>

#include "daemon/load_world.h"
#include "daemon/run_directory.h"
#include "protocol/ideal.h"

namespace scipd::daemon {
namespace {

std::filesystem::path link_of(const RobotConfig& robot, const SensorConfig& sensor) {
    const bool is_auto = sensor.pty->link.empty();
    return is_auto ? run_directory() / tty_name(robot.name, sensor.name) : sensor.pty->link;
}

// Of a port that the system chooses, only the scanner itself says which one it is.
std::string key_of(const RobotConfig& robot, const SensorConfig& sensor) {
    const std::string address = text_of(*sensor.tcp);
    return sensor.tcp->port != 0 ? address
                                 : address + " of " + sensor_name(robot.name, sensor.name);
}

// A tty that nobody has named is the first scipd's; those after it have their own.
std::shared_ptr<PtyPort> open_tty(const boost::asio::any_io_executor& executor,
                                  const RobotConfig& robot, const SensorConfig& sensor) {
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

/// Whether what serves the one will do for the other: a port or the standard input can change
/// hands. A trajectory is played by each robot anew, and a port that the system chooses is its own.
bool can_serve(const std::string& robot, const PoseSource& source, const RobotConfig& other) {
    const bool changes_hands = source.kind == PoseSource::Kind::standard_input ||
                               (source.kind == PoseSource::Kind::udp && source.address.port != 0);
    return source == *other.poses && (changes_hands || robot == other.name);
}

/// But for where its mount lies, if that is a name: another world may have it elsewhere.
bool is_same(const SensorConfig& a, const SensorConfig& b) {
    if (!a.mount || a.robot_from_sensor == b.robot_from_sensor) return a == b;
    SensorConfig moved = a;
    moved.robot_from_sensor = b.robot_from_sensor;
    return moved == b;
}

}  // namespace

Fleet::Fleet(const boost::asio::any_io_executor& executor, ClockKind clock)
    : executor_(executor),
      wall_clock_(executor),
      lockstep_(clock == ClockKind::poses ? std::make_unique<Lockstep>(executor) : nullptr),
      clock_(lockstep_ ? static_cast<Clock&>(lockstep_->clock()) : wall_clock_),
      editor_(world_, worker_, clock_, [this] { return requested_backends(); }),
      chooser_(world_, worker_, [this] { return requested_backends(); }),
      worker_(executor) {
    world_.on_placed([this] {
        for (const auto& station : stations_)
            station->loop->poses_came();
    });
}

Fleet::~Fleet() {
    stop();
}

void Fleet::apply(FleetPlan&& plan) {
    Ports ports = open_ports(plan.config);
    std::vector<Feed> feeds = open_feeds(plan.config);
    take_up(std::move(plan), std::move(ports), std::move(feeds));
}

// An exception on the way would leave ports behind that serve devices which are gone.
void Fleet::take_up(FleetPlan&& plan, Ports ports, std::vector<Feed> feeds) noexcept {
    auto& [config, loaded, backends, notices] = plan;
    for (const std::string& warning : loaded.warnings)
        spdlog::warn("{}", warning);
    for (const auto* notes : {&loaded.notes, &notices}) {
        for (const std::string& note : *notes)
            spdlog::info("{}", note);
    }
    editor_.set_file(config.scene, scene_options(config));
    worker_.discard(std::make_shared<SensorBackends>(
        world_.replace_scene(std::move(loaded.scene), std::move(backends), {}, clock_.now())));
    std::map<std::string, RobotStart> robots;
    for (const RobotConfig& robot : config.robots)
        robots[robot.name] = {robot.world_from_robot, robot.policy, robot.body};
    world_.set_robots(robots);
    replace_stations(config, ports);
    (void)remount();
    ports_ = std::move(ports);
    replace_feeds(std::move(feeds));
}

std::vector<RequestedBackend> Fleet::requested_backends() const {
    const ClockKind clock = lockstep_ ? ClockKind::poses : ClockKind::wall;
    std::vector<RequestedBackend> requests;
    for (const auto& station : stations_) {
        const sim::Pose pose = world_.robot(station->robot)->at(clock_.now());
        requests.push_back(requested_backend(station->robot, station->config, pose, clock));
        requests.back().settled = world_.choice_of(requests.back().sensor);
    }
    return requests;
}

void Fleet::choose_backends() {
    if (!lockstep_) chooser_.choose();
}

SettledBackends Fleet::settled_backends() const {
    SettledBackends settled;
    for (const auto& station : stations_)
        settled[station->name()] = {station->config, world_.choice_of(station->name())};
    return settled;
}

void Fleet::stop() {
    worker_.stop();
    replace_feeds({});
    replace_stations({}, {});
    ports_ = {};
}

Fleet::Ports Fleet::open_ports(const Config& config) const {
    Ports ports;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors) {
            if (sensor.tcp) {
                const std::string key = key_of(robot, sensor);
                const auto open = ports_.tcp.find(key);
                ports.tcp[key] = open != ports_.tcp.end()
                                     ? open->second
                                     : std::make_shared<TcpPort>(executor_, *sensor.tcp);
            }
            if (sensor.pty) {
                const std::filesystem::path link = link_of(robot, sensor);
                const auto open = ports_.pty.find(link);
                ports.pty[link] =
                    open != ports_.pty.end() ? open->second : open_tty(executor_, robot, sensor);
                if (find_unchanged(robot.name, sensor, config.seed) == stations_.end())
                    ports.pty[link]->prepare();
            }
        }
    }
    return ports;
}

std::vector<Fleet::Feed> Fleet::open_feeds(const Config& config) {
    const FeedContext context{
        .executor = executor_,
        .intake = intake_,
        .clock = clock_,
        .lockstep = lockstep_.get(),
        .report = [](const std::string& message) { spdlog::warn("{}", message); }};
    std::vector<Feed> feeds;
    for (const RobotConfig& robot : config.robots) {
        if (!robot.poses) continue;
        const auto open = std::ranges::find_if(
            feeds_, [&](const Feed& feed) { return can_serve(feed.robot, feed.source, robot); });
        feeds.push_back({robot.name, *robot.poses,
                         open != feeds_.end() ? open->feed : make_feed(context, *robot.poses)});
    }
    return feeds;
}

void Fleet::replace_stations(const Config& config, const Ports& ports) noexcept {
    Stations stations;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors) {
            auto station = take_unchanged(robot.name, sensor, config.seed);
            stations.push_back(station ? std::move(station)
                                       : power_up(robot, sensor, config.seed, ports));
        }
    }
    stations.swap(stations_);
    // Ports that a new device has taken over are served by it already; those that nobody needs any
    // more go here, before the devices behind them.
    for (const auto& [key, port] : ports_.tcp) {
        if (!ports.tcp.contains(key)) port->stop();
    }
    for (const auto& [link, port] : ports_.pty) {
        if (!ports.pty.contains(link)) port->stop();
    }
}

Fleet::Stations::const_iterator Fleet::find_unchanged(const std::string& robot,
                                                      const SensorConfig& sensor,
                                                      std::uint64_t seed) const {
    return std::ranges::find_if(stations_, [&](const auto& station) {
        return station->robot == robot && station->seed == seed && is_same(station->config, sensor);
    });
}

std::unique_ptr<Station> Fleet::take_unchanged(const std::string& robot, const SensorConfig& sensor,
                                               std::uint64_t seed) {
    const auto found = find_unchanged(robot, sensor, seed);
    if (found == stations_.end()) return nullptr;
    auto station = std::move(stations_[static_cast<std::size_t>(found - stations_.begin())]);
    stations_.erase(found);
    return station;
}

std::unique_ptr<Station> Fleet::power_up(const RobotConfig& robot, const SensorConfig& sensor,
                                         std::uint64_t seed, const Ports& ports) {
    auto station =
        std::make_unique<Station>(Station{.robot = robot.name, .config = sensor, .seed = seed});
    if (sensor.staring) {
        station->staring =
            std::make_unique<StaringSensor>(robot.name, sensor, seed, world_, clock_);
        station->loop = std::make_unique<ScanLoop>(*station->staring, clock_);
        station->tap =
            std::make_unique<ScanStream::Tap>(stream_, station->name(), *station->staring);
        return station;
    }
    SensorConfig of_device = sensor;
    // Time that stands still would never come to the tick of a reply.
    if (lockstep_) of_device.model.profile = protocol::answering_at_once(of_device.model.profile);
    station->device = std::make_unique<Device>(robot.name, of_device, seed, world_, clock_);
    station->loop = std::make_unique<ScanLoop>(*station->device, clock_);
    station->tap = std::make_unique<ScanStream::Tap>(stream_, station->name(), *station->device);
    if (sensor.tcp) station->tcp = ports.tcp.at(key_of(robot, sensor));
    if (sensor.pty) station->pty = ports.pty.at(link_of(robot, sensor));
    if (station->tcp) station->tcp->serve(*station->device, sensor.link);
    if (station->pty) station->pty->serve(*station->device, sensor.link);
    return station;
}

void Fleet::replace_feeds(std::vector<Feed> feeds) noexcept {
    const auto in = [](const std::vector<Feed>& list, const Feed& feed) {
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
