// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/program/answers.h"

#include <string>
#include <vector>

#include "daemon/command_line/completions.h"
#include "daemon/models/model_list.h"
#include "daemon/models/model_registry.h"
#include "daemon/plan/load_world.h"
#include "sim/backends/registry.h"
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

Answer model_list() {
    return {0, list_of(models())};
}

Answer backend_list() {
    std::string text;
    for (const auto& backend : sim::backends())
        text += std::string{backend.name} + "  " + std::string{backend.description} + "\n";
    return {0, text};
}

Answer completion_script(const CLI::App& app, const std::string& shell) {
    std::string model_names;
    std::string last;
    for (const Model& model : models()) {
        if (model.profile.name == last) continue;
        last = model.profile.name;
        model_names += (model_names.empty() ? "" : " ") + last;
    }
    std::string backend_names = "auto";
    for (const auto& backend : sim::backends())
        backend_names += " " + std::string{backend.name};
    return {0, completions(app, shell, {{"/--model", model_names}, {"/--backend", backend_names}})};
}

Answer probe() {
    Answer answer;
    for (const sim::BackendRow& backend : sim::backends()) {
        if (backend.probe == nullptr) continue;
        const sim::BackendProbe found = backend.probe();
        answer.text += found.text;
        if (!found.usable) answer.exit_code = 1;
    }
    return answer;
}

Answer write_map(const Config& config, const MapRequest& request) {
    const auto told = written(config, request);
    return told ? Answer{0, *told + '\n'} : Answer{2, "scipd: " + told.error().why + '\n'};
}

}  // namespace scipd::daemon
