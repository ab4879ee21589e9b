// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/rig/rig_api.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>
#include <variant>

#include "daemon/device/device.h"
#include "daemon/device/staring_sensor.h"
#include "daemon/fleet/shared_world.h"
#include "daemon/plan/notices.h"
#include "daemon/rig/report.h"
#include "daemon/rig/sensor_editor.h"
#include "daemon/rig/simulation.h"

namespace scipd::daemon {
namespace {

SharedRecord latest_of(const Device& device) {
    return device.log().latest();
}

SharedStaringRecord latest_of(StaringSensor& sensor) {
    return sensor.latest();
}

}  // namespace

RigApi::RigApi(Simulation& simulation)
    : simulation_(simulation),
      faults_(simulation),
      gallery_([&simulation](Worker::Begin begin) { simulation.drawer.add(std::move(begin)); }),
      run_(std::to_string(std::chrono::system_clock::now().time_since_epoch().count())) {}

RigReport RigApi::report() const {
    RigReport report = simulation_.shards.still([&] { return report_of(simulation_); });
    if (shared_ != nullptr) report.fleet = shared_->status();
    return report;
}

Config RigApi::configuration() const {
    Config now = as_it_reads(*config_, simulation_.stations);
    now.media = media();
    for (RobotConfig& robot : now.robots) {
        if (const auto there = robot_pose(robot.name)) robot.world_from_robot = there->pose;
    }
    return now;
}

void RigApi::add_sensor(AddedSensor sensor, EditDone done, std::stop_token withdrawn) {
    sensors_->add(std::move(sensor), std::move(done), std::move(withdrawn));
}

void RigApi::remove_sensor(const std::string& robot, const std::string& sensor, EditDone done,
                           std::stop_token withdrawn) {
    sensors_->remove(robot, sensor, std::move(done), std::move(withdrawn));
}

std::optional<SensorRecord> RigApi::latest(const std::string& sensor) {
    const Station* const station = find_station(simulation_.stations, sensor);
    if (station == nullptr) return std::nullopt;
    SensorRecord latest;
    simulation_.shards.still_on(station->shard, [&] {
        latest = std::visit([](const auto& made) -> SensorRecord { return latest_of(*made); },
                            station->sensor);
    });
    return latest;
}

std::optional<SensorLog> RigApi::log(const std::string& sensor) const {
    const Station* const station = find_station(simulation_.stations, sensor);
    if (station == nullptr) return std::nullopt;
    return simulation_.shards.still([&] {
        return std::visit([](const auto& made) -> SensorLog { return made->log(); },
                          station->sensor);
    });
}

std::optional<ReadingErrors> RigApi::errors(const std::string& sensor) const {
    const Station* const station = find_station(simulation_.stations, sensor);
    if (station == nullptr || station->config.staring) return std::nullopt;
    return errors_of(station->config);
}

sim::Expected<> RigApi::set_errors(const std::string& sensor, const ReadingErrors& errors) {
    Station& station = *find_station(simulation_.stations, sensor);
    if (station.config.replay)
        return sim::refuse("plays a recording, which has the errors of its own scanner");
    const auto lives_elsewhere = [&](const auto& other) {
        return !other->config.staring && other->shard != station.shard;
    };
    if (errors.interference && !station.config.interference &&
        std::ranges::any_of(simulation_.stations, lives_elsewhere)) {
        return sim::refuse(
            "interference needs scanners that live on one thread, and these live on several: put "
            "it into the configuration and start scipd again, or start it with --threads 1");
    }
    simulation_.shards.still([&] { station.read_as(errors); });
    return {};
}

std::optional<ReplayStatus> RigApi::replay(const std::string& sensor) const {
    const Station* const station = find_station(simulation_.stations, sensor);
    if (station == nullptr || !station->config.replay) return std::nullopt;
    Device& device = *std::get<std::unique_ptr<Device>>(station->sensor);
    return simulation_.shards.still([&] { return device.replay_status(); });
}

ReplayStatus RigApi::steer_replay(const std::string& sensor, const ReplaySteering& steering) {
    const Station& station = *find_station(simulation_.stations, sensor);
    Device& device = *std::get<std::unique_ptr<Device>>(station.sensor);
    return simulation_.shards.still([&] { return device.steer_replay(steering); });
}

void RigApi::ask_log(const std::string& sensor) {
    simulation_.shards.still([&] {
        std::visit([](const auto& made) { made->ask_log(); },
                   find_station(simulation_.stations, sensor)->sensor);
    });
}

std::unique_ptr<Conversation> RigApi::subscribe(const std::string& sensor, WebSocket& socket) {
    return simulation_.stream.subscribe(sensor, socket);
}

Recordings& RigApi::recordings() {
    return simulation_.recordings;
}

std::unique_ptr<Conversation> RigApi::open_view(WebSocket& page) {
    return simulation_.view.open(page, [this] { return world(); });
}

std::unique_ptr<Conversation> RigApi::open_wire(const std::string& sensor, WebSocket& socket) {
    return simulation_.wire.open(sensor, socket);
}

sim::Expected<> RigApi::admit_pose(Rate& sender) {
    return simulation_.intake.admit(sender);
}

sim::Expected<> RigApi::take_pose_line(std::string_view line, SenderClock& sender) {
    return simulation_.intake.take_line(line, {}, sender, simulation_.clock.now());
}

SceneView RigApi::scene() const {
    return {simulation_.editor.file(), simulation_.world.scene()};
}

WorldView RigApi::world() const {
    const World& world = simulation_.world;
    const sim::Time now = simulation_.clock.now();
    WorldView view{.version = run_ + '-' + std::to_string(world.edition()),
                   .loaded = run_ + '-' + std::to_string(simulation_.editor.loads()),
                   .most_body_bytes = simulation_.limits->values()[Limit::http_body_bytes],
                   .scene = world.scene(),
                   .materials = world.light().materials(),
                   .time = simulation_.clock.origin() + now,
                   .models = world.poses_at(now)};
    for (const auto& [name, robot] : world.robots())
        view.robots.push_back({name, robot.track.at(now), world.body_of(name)});
    return view;
}

// The others are told of an edit that is made, so none is withdrawn.
void RigApi::edit_scene(SceneEdit edit, EditDone done, std::stop_token withdrawn) {
    if (shared_ != nullptr) return shared_->edit(std::move(edit), std::move(done));
    edit_here(std::move(edit), std::move(done), std::move(withdrawn));
}

void RigApi::edit_here(SceneEdit edit, EditDone done, std::stop_token withdrawn) {
    auto told = [&simulation = simulation_, done = std::move(done)](EditOutcome outcome) {
        if (outcome.result != EditOutcome::Result::done) return done(outcome);
        std::ranges::move(simulation.remount(), std::back_inserter(outcome.messages));
        done(outcome);
        simulation.choose_backends();
    };
    simulation_.editor.edit(std::move(edit), std::move(told), std::move(withdrawn));
}

std::vector<sim::Medium> RigApi::media() const {
    return simulation_.world.light().media();
}

std::vector<std::string> RigApi::set_media(std::vector<sim::Medium> media) {
    const bool seen = media.empty() || std::ranges::any_of(simulation_.stations, [](const auto& s) {
                          return s->config.sees_light();
                      });
    simulation_.world.set_media(media);
    return seen ? std::vector<std::string>{} : std::vector{std::string(unseen_media)};
}

std::optional<sim::TimedPose> RigApi::robot_pose(const std::string& robot) const {
    const sim::PoseTrack* const track = simulation_.world.robot(robot);
    if (track == nullptr) return std::nullopt;
    const sim::Time now = simulation_.clock.now();
    return sim::TimedPose{simulation_.clock.origin() + now, track->at(now)};
}

sim::Expected<> RigApi::set_robot_pose(const std::string& robot, const sim::PoseLine& said) {
    return simulation_.intake.take(said, robot, robot_senders_[robot], simulation_.clock.now());
}

std::optional<sim::TimedPose> RigApi::model_pose(const std::string& model) const {
    const sim::Time now = simulation_.clock.now();
    const auto pose = simulation_.world.model_pose(model, now);
    if (!pose) return std::nullopt;
    return sim::TimedPose{simulation_.clock.origin() + now, *pose};
}

sim::Expected<> RigApi::set_model_pose(const std::string& model, const sim::PoseLine& said) {
    sim::PoseLine line = said;
    line.model = model;
    return simulation_.intake.take(line, {}, model_senders_[model], simulation_.clock.now());
}

}  // namespace scipd::daemon
