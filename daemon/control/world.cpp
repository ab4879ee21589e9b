// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/control/world.h"

#include <utility>

namespace scipd::daemon {
namespace {

// Poses farther apart in time do not belong to one movement: the thing rests and then is somewhere
// else.
constexpr sim::Time longest_step = std::chrono::seconds(1);

std::optional<std::string> place(sim::PoseTrack& track, sim::Time time, const sim::Pose& pose) {
    if (time <= track.last_time()) return "t: not later than the pose before it";
    if (time - longest_step > track.last_time()) {
        track.jump(time, pose);
    } else {
        track.append(time, pose);
    }
    return std::nullopt;
}

template <class Map>
std::string names_of(const Map& map) {
    std::string text;
    for (const auto& [name, value] : map)
        text += (text.empty() ? "" : ", ") + name;
    return text.empty() ? "none" : text;
}

}  // namespace

void World::replace_scene(sim::SharedScene scene, Backends backends) {
    scene_ = std::move(scene);
    backends_ = std::move(backends);
    movable_.clear();
    for (sim::ModelId id = 0; id < scene_->models.size(); ++id) {
        const auto& [name, movable, pose] = scene_->models[id];
        if (movable) movable_.emplace(name, MovableModel{id, sim::PoseTrack(pose), pose});
    }
}

void World::set_robots(const std::map<std::string, sim::Pose>& world_from_robot) {
    std::erase_if(robots_,
                  [&](const auto& robot) { return !world_from_robot.contains(robot.first); });
    for (const auto& [name, start] : world_from_robot) {
        const auto known = robots_.find(name);
        if (known != robots_.end() && known->second.start == start) continue;
        robots_.insert_or_assign(name, Robot{start, sim::PoseTrack(start)});
    }
}

const sim::PoseTrack* World::robot(std::string_view name) const {
    const auto found = robots_.find(name);
    return found == robots_.end() ? nullptr : &found->second.track;
}

std::optional<std::string> World::place_robot(std::string_view name, sim::Time time,
                                              const sim::Pose& world_from_robot) {
    const auto found = robots_.find(name);
    if (found == robots_.end()) {
        return "robot: there is no \"" + std::string(name) + "\"; robots are " + names_of(robots_);
    }
    return place(found->second.track, time, world_from_robot);
}

std::optional<std::string> World::place_only_robot(sim::Time time,
                                                   const sim::Pose& world_from_robot) {
    if (robots_.size() != 1) return "robot: say which; robots are " + names_of(robots_);
    return place(robots_.begin()->second.track, time, world_from_robot);
}

std::optional<std::string> World::place_model(std::string_view name, sim::Time time,
                                              const sim::Pose& world_from_model) {
    const auto found = movable_.find(name);
    if (found == movable_.end()) {
        return "model: there is no movable \"" + std::string(name) + "\"; movable models are " +
               names_of(movable_);
    }
    return place(found->second.track, time, world_from_model);
}

sim::RangeBackend& World::backend_at(std::string_view name, sim::Time time) {
    for (auto& [model_name, model] : movable_) {
        const sim::Pose pose = model.track.at(time);
        if (pose == model.placed) continue;
        for (const auto& [backend_name, backend] : backends_)
            backend->move(model.id, pose);
        model.placed = pose;
    }
    return *backends_.find(name)->second;
}

}  // namespace scipd::daemon
