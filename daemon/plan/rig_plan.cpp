// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/rig_plan.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <spdlog/spdlog.h>

#include "daemon/plan/load_world.h"
#include "daemon/plan/mounting.h"
#include "daemon/plan/notices.h"
#include "daemon/plan/unlikely_places.h"
#include "daemon/world/backend_maker.h"
#include "sim/loaders/file/load_error.h"
#include "sim/sensor/scanner.h"
#include "sim/world/lit_world.h"

namespace scipd::daemon {
namespace {

std::vector<glm::vec3> directions_of(const SensorConfig& sensor) {
    if (sensor.staring) return sensor.staring->directions();
    const sim::Scanner scanner(sensor.model.optics, {.accuracy = sensor.accuracy});
    return {scanner.directions().begin(), scanner.directions().end()};
}

/// What a user should know who named a backend that cannot follow light.
std::optional<std::string> blind_spot(const RequestedBackend& request, const sim::Scene& scene,
                                      SensorBackends& backends) {
    const bool goes_on =
        request.materials && sim::light_goes_on(scene, *request.materials, request.wavelength_nm);
    if (!goes_on || backends.of(request.sensor).follows_light()) return std::nullopt;
    return request.sensor + ": backend " + *request.backend +
           " sees no second surface behind glass or in a mirror; take embree or auto for that";
}

std::optional<std::string> named_backend(const SensorConfig& sensor) {
    return sensor.backend == auto_backend ? std::nullopt : std::optional(sensor.backend);
}

/// What others have made of the world.
struct Shared {
    AddedTriangles added;
    std::map<std::string, std::string> failed;  ///< why not, by model
    sim::Time age{};
};

/// Makes it. Empty where it is made, or takes away a model that is not there.
std::string why_not_made(const SceneEdit& edit, PresentScene& present,
                         std::vector<std::string>& warnings) {
    try {
        EditedOrNot now = edited(edit, present);
        if (!now && now.error().result == EditOutcome::Result::unknown) return {};
        if (!now) return in_one_line(now.error().messages);
        present.scene = std::move(now->scene);
        present.added = std::move(now->all_added);
        std::ranges::move(now->warnings, std::back_inserter(warnings));
        return {};
    } catch (const sim::LoadError& error) {
        if (present.options.limits.stop.stop_requested()) throw;
        return in_one_line(error.faults());
    }
}

/// What cannot be made here is left out: nobody shall keep a daemon from starting by a message.
Shared share(const Config& config, const sim::SharedMaterials& materials,
             const std::stop_token& stop, const JoinedWorld& joined, sim::LoadedScene& loaded) {
    PresentScene present{config.scene, loaded.scene, scene_options(config, materials),
                         config.allow, {},           config.client_limits};
    present.options.limits.stop = stop;
    Shared shared{.age = joined.age};
    for (const SceneEdit& edit : joined.edits) {
        std::string why = why_not_made(edit, present, loaded.warnings);
        if (!why.empty()) shared.failed[model_of(edit)] = std::move(why);
    }
    loaded.scene = present.scene;
    shared.added = std::move(present.added);
    return shared;
}

}  // namespace

RequestedBackend requested_backend(const std::string& robot, const SensorConfig& sensor,
                                   const sim::Pose& world_from_robot, ClockKind clock,
                                   const sim::SharedMaterials& materials) {
    const double max_range_m =
        sensor.staring ? sensor.staring->max_range_m : sensor.model.optics.max_range_m;
    std::vector<glm::vec3> directions = directions_of(sensor);
    const int beams = sensor.staring ? sensor.staring->beams() : sensor.model.optics.beams();
    RequestedBackend request{.sensor = sensor_name(robot, sensor.name),
                             .backend = named_backend(sensor),
                             .depth = sensor.depth,
                             .directions = std::move(directions),
                             .poses = sensor.motion.value_or(beams),
                             .world_from_sensor = world_from_robot * sensor.robot_from_sensor,
                             .max_range_m = static_cast<float>(max_range_m)};
    if (sensor.sees_light()) {
        request.materials = materials;
        request.wavelength_nm = sensor.model.optics.receiver.wavelength_nm;
    }
    if (clock == ClockKind::poses)
        request.settled = unmeasured_choice("in lockstep two runs have to be the same");
    return request;
}

RigPlan make_plan(Config config, const Running& running, const std::stop_token& stop,
                  const JoinWorld& join) {
    const bool goes_on = running.world.has_value();
    std::optional<Scenario> scenario = goes_on ? std::nullopt : load_scenario(config);
    LoadedTrajectories trajectories = load_trajectories(config, running.played, stop);
    LoadedTapes tapes = load_tapes(config, stop);
    LoadedMaterials materials =
        goes_on ? LoadedMaterials{running.world->materials, {}} : load_materials(config);
    sim::LoadedScene loaded = goes_on ? sim::LoadedScene{running.world->scene, {}}
                                      : load_world(config, materials.library, stop);
    Shared shared;
    if (join) shared = share(config, materials.library, stop, join(*loaded.scene), loaded);
    std::ranges::move(materials.warnings, std::back_inserter(loaded.warnings));
    std::ranges::move(tapes.warnings, std::back_inserter(loaded.warnings));
    std::vector<std::string> notices =
        mount_by_name(config, *loaded.scene, goes_on ? running.sensors : KnownSensors{});
    std::ranges::move(warnings_of(config, *loaded.scene), std::back_inserter(loaded.warnings));
    // A sensor that is mounted by name is unknown before it has its place.
    std::ranges::move(serial_notices(config, running.sensors), std::back_inserter(notices));
    Homes homes = find_homes(config, running.homes, running.sensors);
    if (!goes_on) {
        std::ranges::move(media_notices(config), std::back_inserter(notices));
        for (const std::string& notice :
             material_notices(config, *loaded.scene, *materials.library))
            spdlog::debug("{}", notice);
    }
    std::vector<RequestedBackend> requests;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors) {
            RequestedBackend request = requested_backend(robot.name, sensor, robot.world_from_robot,
                                                         config.clock, materials.library);
            request.shard = homes.sensors.at(request.sensor);
            const KnownSensor* const before = find_known(running.sensors, request.sensor, sensor);
            if (!request.settled && before != nullptr) request.settled = before->choice;
            requests.push_back(std::move(request));
        }
    }
    SensorBackends backends = make_backends(requests, loaded.scene);
    for (const RequestedBackend& request : requests) {
        if (auto notice = blind_spot(request, *loaded.scene, backends))
            notices.push_back(*std::move(notice));
    }
    return {.world_goes_on = goes_on,
            .config = std::move(config),
            .homes = std::move(homes),
            .loaded = std::move(loaded),
            .backends = std::move(backends),
            .notices = std::move(notices),
            .materials = std::move(materials.library),
            .scenario = std::move(scenario),
            .trajectories = std::move(trajectories),
            .tracks = std::move(tapes.tracks),
            .added = std::move(shared.added),
            .unlike_the_others = std::move(shared.failed),
            .scripts_age = shared.age};
}

}  // namespace scipd::daemon
