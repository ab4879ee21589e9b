// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/world.h"

#include <algorithm>
#include <chrono>
#include <vector>

#include <glm/geometric.hpp>

#include "sim/world/bounds.h"
#include "sim/world/script.h"

namespace scipd::daemon {
namespace {

using Reason = NotPlaced::Reason;

template <class Map>
std::string names_of(const Map& map) {
    constexpr std::size_t most = 16;
    std::string text;
    std::size_t told = 0;
    for (const auto& [name, value] : map) {
        if (told++ == most) return text + " and " + std::to_string(map.size() - most) + " more";
        text += (text.empty() ? "" : ", ") + name;
    }
    return text.empty() ? "none" : text;
}

/// The radius of each movable model around its origin, by ModelId.
std::vector<double> radii_m(const sim::Scene& scene) {
    std::vector<double> radii(scene.models.size(), 0.0);
    for (const sim::Object& object : scene.objects) {
        if (!scene.models[object.model].movable) continue;
        sim::Bounds bounds;
        bounds.include(sim::bounds_of(object.shape), object.model_from_object);
        if (bounds.empty()) continue;
        const glm::dvec3 farthest = glm::max(glm::abs(bounds.low_m), glm::abs(bounds.high_m));
        radii[object.model] = std::max(radii[object.model], glm::length(farthest));
    }
    return radii;
}

bool same(const sim::SharedScript& a, const sim::SharedScript& b) {
    return a == b || (a && b && *a == *b);
}

/// Sweeps that are measured late ask for poses as old as this, not older.
constexpr sim::Time recent = std::chrono::seconds(2);

tl::unexpected<NotPlaced> refuse(NotPlaced::Reason reason, std::string field, std::string why) {
    return tl::unexpected(NotPlaced{{std::move(field), std::move(why)}, reason});
}

}  // namespace

SensorBackends World::replace_scene(sim::SharedScene scene, SensorBackends backends,
                                    const std::set<std::string>& placed_anew, sim::Time now) {
    scene_ = std::move(scene);
    ++edition_;
    names_ = sim::without_shapes(*scene_);
    SensorBackends old = exchange_backends(std::move(backends));
    auto before = std::exchange(movable_, {});
    const std::vector<double> radii = radii_m(*scene_);
    for (sim::ModelId id = 0; id < scene_->models.size(); ++id) {
        const auto& [name, movable, start, script] = scene_->models[id];
        if (!movable) continue;
        MovableModel model{id, start, radii[id], sim::PoseTrack(start), script, now};
        const auto known = before.find(name);
        const bool stays = known != before.end() && known->second.start == start &&
                           same(known->second.script, script) && !placed_anew.contains(name);
        if (stays) {
            model.track = std::move(known->second.track);
            model.begun = known->second.begun;
            model.placed = known->second.placed;
        }
        movable_.emplace(name, std::move(model));
    }
    find_carriers();
    tell(
        [&, now](World& copy) {
            (void)copy.replace_scene(scene_, backends_.of_shard(*copy.shard_), placed_anew, now);
        },
        Haste::now);
    return old;
}

SensorBackends World::replace_backends(SensorBackends backends) {
    SensorBackends old = exchange_backends(std::move(backends));
    tell([this](World& copy) { (void)copy.replace_backends(backends_.of_shard(*copy.shard_)); },
         Haste::now);
    return old;
}

// Backends of an original are at work in its copies.
SensorBackends World::exchange_backends(SensorBackends backends) {
    SensorBackends old = std::exchange(backends_, std::move(backends));
    if (!shard_) backends_.log_changes_since(old);
    if (!on_change_) old.leave_thread();
    return old;
}

void World::set_materials(const sim::SharedMaterials& materials) {
    light_.set_materials(materials);
    ++edition_;
    tell([&](World& copy) { copy.set_materials(materials); }, Haste::now);
}

void World::set_media(const std::vector<sim::Medium>& media) {
    light_.set_media(media);
    tell([&](World& copy) { copy.set_media(media); }, Haste::now);
}

void World::configure_media(const std::vector<sim::Medium>& media) {
    light_.configure_media(media);
    tell([&](World& copy) { copy.configure_media(media); }, Haste::now);
}

void World::set_robots(const std::map<std::string, RobotStart>& robots) {
    std::erase_if(robots_, [&](const auto& robot) { return !robots.contains(robot.first); });
    for (const auto& [name, start] : robots) {
        const auto known = robots_.find(name);
        if (known != robots_.end() && known->second.start == start) continue;
        robots_.insert_or_assign(
            name, Robot{start, sim::PoseTrack(start.world_from_robot, start.policy)});
    }
    find_carriers();
    ++edition_;
    tell([&](World& copy) { copy.set_robots(robots); }, Haste::now);
}

void World::find_carriers() {
    for (auto& [name, model] : movable_)
        model.carrier = nullptr;
    for (const auto& [name, robot] : robots_) {
        const auto body = movable_.find(robot.start.body);
        if (body != movable_.end()) body->second.carrier = &robot;
    }
    movers_.view(movable_);
}

const sim::PoseTrack* World::robot(std::string_view name) const {
    const auto found = robots_.find(name);
    return found == robots_.end() ? nullptr : &found->second.track;
}

const sim::PoseTrack* World::model(std::string_view name) const {
    const auto found = movable_.find(name);
    return found == movable_.end() ? nullptr : &found->second.path();
}

std::optional<sim::Pose> World::model_pose(std::string_view name, sim::Time time) const {
    const auto found = movable_.find(name);
    if (found == movable_.end()) return std::nullopt;
    return found->second.at(time);
}

sim::ModelId World::body_of(std::string_view robot) const {
    const auto found = robots_.find(robot);
    if (found == robots_.end()) return sim::no_model;
    const auto body = movable_.find(found->second.start.body);
    return body == movable_.end() ? sim::no_model : body->second.id;
}

std::map<std::string, std::string> World::lost_bodies() const {
    std::map<std::string, std::string> lost;
    for (const auto& [name, robot] : robots_) {
        const std::string& body = robot.start.body;
        if (!body.empty() && !movable_.contains(body)) lost[name] = body;
    }
    return lost;
}

Placed World::place_robot(std::string_view name, const Placement& placement) {
    const auto found = robots_.find(name);
    if (found == robots_.end()) {
        return refuse(
            Reason::unknown, "robot",
            "robot: there is no \"" + std::string(name) + "\"; robots are " + names_of(robots_));
    }
    const sim::Time left = found->second.track.last_time();
    return place(found->second.track, placement).map([&] {
        const auto body = movable_.find(found->second.start.body);
        if (body != movable_.end()) movers_.goes_to(body->second, placement.pose, left);
        tell([name = found->first,
              placement](World& copy) { (void)copy.place_robot(name, placement); },
             Haste::soon);
    });
}

Placed World::place_only_robot(const Placement& placement) {
    if (robots_.size() != 1) {
        return refuse(Reason::unknown, "robot",
                      "robot is missing; robots are " + names_of(robots_));
    }
    return place_robot(robots_.begin()->first, placement);
}

Placed World::place_model(std::string_view name, const Placement& placement) {
    const auto found = movable_.find(name);
    if (found == movable_.end()) {
        return refuse(Reason::unknown, "model",
                      "model: there is no movable \"" + std::string(name) +
                          "\"; movable models are " + names_of(movable_));
    }
    if (found->second.carrier != nullptr) {
        return refuse(
            Reason::carried, "model",
            "model: \"" + std::string(name) + "\" is the body of a robot; move the robot");
    }
    MovableModel& model = found->second;
    const sim::Time left = model.track.last_time();
    if (model.follows_script()) {
        end_script(model, placement);
        movers_.leaves_script(model);
    } else if (Placed placed = place(model.track, placement); !placed) {
        return placed;
    } else {
        movers_.goes_to(model, placement.pose, left);
    }
    tell([name = found->first, placement](World& copy) { (void)copy.place_model(name, placement); },
         Haste::soon);
    return {};
}

// Keeps its recent motion, for sweeps that are measured later.
void World::end_script(MovableModel& model, const Placement& placement) {
    model.track = model.script->between(model.begun, placement.time - recent, placement.time);
    model.track.jump(placement.time, placement.pose);
    model.placed = true;
    if (on_placed_) on_placed_();
}

Placed World::place(sim::PoseTrack& track, const Placement& placement) {
    if (placement.from_now_on && placement.time <= track.last_time()) {
        track.jump(placement.time, placement.pose);
    } else if (!track.place(placement.time, placement.pose, placement.velocity)) {
        return refuse(Reason::not_later, "t", "t: not later than the pose before it");
    }
    if (on_placed_) on_placed_();
    return {};
}

bool World::has_one_mover() const {
    const auto moves_alone = [](const auto& model) { return model.second.carrier == nullptr; };
    return robots_.size() == 1 && std::ranges::none_of(movable_, moves_alone);
}

bool World::poses_known(sim::Time until) const {
    const auto expected = [&](const sim::PoseTrack& track) {
        return track.live(until) && track.last_time() < until;
    };
    return std::ranges::none_of(robots_,
                                [&](const auto& robot) { return expected(robot.second.track); }) &&
           std::ranges::none_of(movable_, [&](const auto& model) {
               return !model.second.follows_script() && expected(model.second.path());
           });
}

std::vector<sim::Pose> World::poses_at(sim::Time time) const {
    std::vector<sim::Pose> poses;
    poses.reserve(scene_->models.size());
    for (const sim::Model& model : scene_->models)
        poses.push_back(model.world_from_model);
    for (const auto& [name, model] : movable_)
        poses[model.id] = model.at(time);
    return poses;
}

}  // namespace scipd::daemon
