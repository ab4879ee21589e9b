// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/place_watch.h"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>
#include <spdlog/spdlog.h>

#include "sim/backends/surroundings.h"
#include "sim/sensor/scan.h"

namespace scipd::daemon {
namespace {

/// A sensor that moves farther than this from one scan to the next has jumped.
constexpr double jump_m = 1.0;
/// Only a robot's own parts are as close as this all around a sensor.
constexpr float close_m = 0.3F;

/// The object that all beams meet close by. Nothing is known where the beams point to one side
/// only.
std::optional<sim::ObjectId> all_around(const Cast& cast, const sim::Scene& scene) {
    const auto& hits = cast.scan.hits;
    if (!cast.looks_around || hits.empty() || !hits.front().met()) return {};
    const sim::ModelId model = scene.objects[hits.front().object].model;
    const bool same = std::ranges::all_of(hits, [&](const sim::Hit& hit) {
        return hit.met() && hit.range_m < close_m && scene.objects[hit.object].model == model;
    });
    return same ? std::optional{hits.front().object} : std::nullopt;
}

/// What the user can do about it.
std::string advice(const std::string& robot, const sim::Model* around) {
    const std::string elsewhere =
        "put robot \"" + robot + "\" elsewhere (pose), or the sensor on it (mount)";
    if (around == nullptr || !around->movable) return "; " + elsewhere;
    return "; if " + around->name + " is the robot, name it as its body (body: " + around->name +
           "), else " + elsewhere;
}

std::string warning_of(const std::string& robot, const sim::OddPlace& odd,
                       const sim::Scene& scene) {
    const sim::Object& object = scene.objects[odd.object];
    const sim::Model& model = scene.models[object.model];
    const std::string what = "model " + model.name + " (" + object.name + ")";
    if (odd.kind == sim::OddPlace::Kind::below) {
        return "lies below the ground, " + what + advice(robot, nullptr);
    }
    return "is inside " + what +
           ", which is solid, so that its beams meet nothing outside; if it is meant as a room, "
           "the inside of its walls is measured and this may stay" +
           advice(robot, &model);
}

std::string warning_of(const std::string& robot, sim::ObjectId all_around,
                       const sim::Scene& scene) {
    const sim::Object& object = scene.objects[all_around];
    const sim::Model& model = scene.models[object.model];
    return "is inside model " + model.name + " (" + object.name +
           "), which every beam meets close by" + advice(robot, &model);
}

}  // namespace

PlaceGlance::PlaceGlance(World& world, Tell tell) : world_(world), tell_(std::move(tell)) {
    world_.on_cast([this](const Cast& cast) { see(cast); });
}

void PlaceGlance::see(const Cast& cast) {
    Seen& seen = seen_[cast.sensor];
    const sim::SharedScene& scene = world_.scene();
    const glm::dvec3 at_m = cast.scan.world_from_sensor.front().translation_m;
    const bool jumped = glm::distance(std::exchange(seen.at_m, at_m), at_m) > jump_m;
    if (!jumped && seen.scene.lock() == scene) return;
    seen.scene = scene;
    tell_({cast.robot,
           cast.sensor,
           scene,
           at_m,
           cast.scan.posed_at.front(),
           all_around(cast, *scene),
           world_.body_of(cast.robot),
           {cast.housing.begin(), cast.housing.end()}});
}

std::optional<std::string> PlaceWatch::warning(const std::string& sensor) const {
    const auto look = looks_.find(sensor);
    if (look == looks_.end() || look->second.warning.empty()) return {};
    return look->second.warning;
}

void PlaceWatch::look_at(NewPlace place) {
    waiting_.push_back(std::move(place));
    if (waiting_.size() == 1) worker_.add([this] { return answer(); });
}

Worker::Work PlaceWatch::answer() {
    return [this, scene = world_.scene(), poses = world_.poses_at(waiting_.back().time),
            places = std::exchange(waiting_, {})]() -> Worker::Finish {
        std::map<std::string, std::string> warnings;
        for (const NewPlace& place : places) {
            // The scene was replaced meanwhile; the sensor will be looked at in the new one.
            if (place.scene.lock() != scene) continue;
            std::string& warning = warnings[place.sensor];
            const auto odd = sim::odd_place(*scene, poses, place.at_m, {place.body, place.housing});
            if (odd) {
                warning = warning_of(place.robot, *odd, *scene);
            } else if (place.all_around) {
                warning = warning_of(place.robot, *place.all_around, *scene);
            }
        }
        return [this, warnings = std::move(warnings)] {
            for (const auto& [sensor, warning] : warnings)
                take(sensor, warning);
        };
    };
}

void PlaceWatch::take(const std::string& sensor, const std::string& warning) {
    Look& look = looks_[sensor];
    look.warning = warning;
    if (warning.empty() || warning == look.told) return;
    look.told = warning;
    spdlog::warn("{}: {}", sensor, warning);
}

}  // namespace scipd::daemon
