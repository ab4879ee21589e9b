// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/program/map_answer.h"

#include <string>
#include <vector>

#include "daemon/plan/load_materials.h"
#include "daemon/plan/load_world.h"
#include "sim/export/floor_map.h"
#include "sim/export/ros_map_files.h"

namespace scipd::daemon {
namespace {

bool is_of_a_robot(const sim::PlacedMesh& placed, const Config& config) {
    for (const RobotConfig& robot : config.robots) {
        if (!robot.body.empty() && placed.name.starts_with(robot.body + "::")) return true;
    }
    return false;
}

sim::Expected<std::string> written(const Config& config, const MapRequest& request) {
    if (!request.heights)
        return sim::refuse("--map needs --map-z, the height of the scanner above z = 0 in m");
    const sim::LoadedScene loaded = load_world(config, load_materials(config).library);
    std::vector<sim::PlacedMesh> meshes = sim::placed_meshes(*loaded.scene);
    std::erase_if(meshes,
                  [&](const sim::PlacedMesh& placed) { return is_of_a_robot(placed, config); });
    sim::FloorMapOptions options{
        .low_m = request.heights->low_m, .high_m = request.heights->high_m, .robots_m = {}};
    options.resolution_m = request.resolution_m.value_or(options.resolution_m);
    for (const RobotConfig& robot : config.robots)
        options.robots_m.emplace_back(robot.world_from_robot.translation_m);
    return sim::floor_map(meshes, options).and_then([&](const sim::FloorMap& map) {
        return sim::write_ros_map(map, request.file);
    });
}

}  // namespace

Answer write_map(const Config& config, const MapRequest& request) {
    const auto told = written(config, request);
    return told ? Answer{0, *told + '\n'} : Answer{2, "scipd: " + told.error().why + '\n'};
}

}  // namespace scipd::daemon
