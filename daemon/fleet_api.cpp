// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the control API asks a fleet for.
#include <algorithm>
#include <iterator>
#include <utility>

#include "daemon/fleet.h"
#include "daemon/mounting.h"

namespace scipd::daemon {

const Station* Fleet::find(const std::string& sensor) const {
    const auto found = std::ranges::find_if(
        stations_, [&](const auto& station) { return station->name() == sensor; });
    return found == stations_.end() ? nullptr : found->get();
}

const ScanLog* Fleet::scans(const std::string& sensor) const {
    const Station* const station = find(sensor);
    return station != nullptr && station->device ? &station->device->log() : nullptr;
}

StaringSensor* Fleet::staring(const std::string& sensor) {
    const Station* const station = find(sensor);
    return station != nullptr ? station->staring.get() : nullptr;
}

std::map<std::string, Address> Fleet::pose_addresses() const {
    std::map<std::string, Address> addresses;
    for (const Feed& feed : feeds_) {
        if (const auto address = feed.feed->address()) addresses[feed.robot] = *address;
    }
    return addresses;
}

sim::Expected<> Fleet::take_pose_line(std::string_view line, SenderClock& sender) {
    return intake_.take_line(line, {}, sender, clock_.now());
}

SceneView Fleet::scene() const {
    return {editor_.file(), world_.scene()};
}

void Fleet::edit_scene(SceneEdit edit, EditDone done, std::stop_token withdrawn) {
    auto told = [this, done = std::move(done)](EditOutcome outcome) {
        if (outcome.result != EditOutcome::Result::done) return done(outcome);
        std::ranges::move(remount(), std::back_inserter(outcome.messages));
        done(outcome);
        choose_backends();
    };
    editor_.edit(std::move(edit), std::move(told), std::move(withdrawn));
}

std::vector<std::string> Fleet::remount() {
    std::vector<std::string> warnings;
    for (const auto& station : stations_) {
        SensorConfig& sensor = station->config;
        if (!sensor.mount) continue;
        if (const auto pose = mounted_again(*sensor.mount, *world_.scene())) {
            sensor.robot_from_sensor = *pose;
            station->device ? station->device->mount(*pose) : station->staring->mount(*pose);
        } else {
            warnings.push_back(editor_.file().string() + ": has no \"" + sensor.mount->name +
                               "\" in a model \"" + sensor.mount->model + "\" to mount " +
                               station->name() + " on; it stays where it was");
        }
    }
    return warnings;
}

std::optional<sim::TimedPose> Fleet::pose_now(const sim::PoseTrack* track) const {
    if (track == nullptr) return std::nullopt;
    const sim::Time now = clock_.now();
    return sim::TimedPose{clock_.origin() + now, track->at(now)};
}

std::optional<sim::TimedPose> Fleet::robot_pose(const std::string& robot) const {
    return pose_now(world_.robot(robot));
}

sim::Expected<> Fleet::set_robot_pose(const std::string& robot, const sim::PoseLine& said) {
    return intake_.take(said, robot, api_senders_[robot], clock_.now());
}

std::optional<sim::TimedPose> Fleet::model_pose(const std::string& model) const {
    const sim::Time now = clock_.now();
    const auto pose = world_.model_pose(model, now);
    if (!pose) return std::nullopt;
    return sim::TimedPose{clock_.origin() + now, *pose};
}

sim::Expected<> Fleet::set_model_pose(const std::string& model, const sim::PoseLine& said) {
    sim::PoseLine line = said;
    line.model = model;
    return intake_.take(line, {}, api_model_senders_[model], clock_.now());
}

}  // namespace scipd::daemon
