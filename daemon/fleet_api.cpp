// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the control API asks a fleet for.
#include <algorithm>
#include <utility>

#include "daemon/fleet.h"

namespace scipd::daemon {

const Fleet::Station* Fleet::find(const std::string& sensor) const {
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

std::optional<std::string> Fleet::take_pose_line(std::string_view line, SenderClock& sender) {
    return intake_.take_line(line, {}, sender, clock_.now());
}

SceneView Fleet::scene() const {
    return {editor_.file(), world_.scene()};
}

void Fleet::edit_scene(SceneEdit edit, EditDone done, std::stop_token withdrawn) {
    auto told = [this, done = std::move(done)](const EditOutcome& outcome) {
        done(outcome);
        if (outcome.result == EditOutcome::Result::done) choose_backends();
    };
    editor_.edit(std::move(edit), std::move(told), std::move(withdrawn));
}

std::optional<sim::TimedPose> Fleet::pose_now(const sim::PoseTrack* track) const {
    if (track == nullptr) return std::nullopt;
    const sim::Time now = clock_.now();
    return sim::TimedPose{clock_.origin() + now, track->at(now)};
}

std::optional<sim::TimedPose> Fleet::robot_pose(const std::string& robot) const {
    return pose_now(world_.robot(robot));
}

std::optional<std::string> Fleet::set_robot_pose(const std::string& robot,
                                                 std::optional<sim::Time> time,
                                                 const sim::Pose& world_from_robot) {
    return intake_.take({.robot = robot, .time = time, .pose = world_from_robot}, robot,
                        api_senders_[robot], clock_.now());
}

std::optional<sim::TimedPose> Fleet::model_pose(const std::string& model) const {
    return pose_now(world_.model(model));
}

std::optional<std::string> Fleet::set_model_pose(const std::string& model,
                                                 std::optional<sim::Time> time,
                                                 const sim::Pose& world_from_model) {
    return intake_.take({.model = model, .time = time, .pose = world_from_model}, {},
                        api_model_senders_[model], clock_.now());
}

}  // namespace scipd::daemon
