// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/reader/read_scene.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <string>
#include <string_view>
#include <variant>

#include "sim/loaders/file/crowding.h"
#include "sim/loaders/file/doing.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/map/ros_map.h"
#include "sim/loaders/mesh/mesh_file.h"
#include "sim/loaders/mesh/mesh_scene.h"
#include "sim/loaders/model/model_fragment.h"
#include "sim/loaders/mvsim/mvsim_scene.h"
#include "sim/loaders/sdf/sdf.h"
#include "sim/loaders/stage/stage_scene.h"
#include "sim/loaders/xacro/xacro.h"
#include "sim/world/anchor.h"

namespace scipd::sim {
namespace {

bool is_folder(const std::filesystem::path& file) {
    std::error_code error;
    return std::filesystem::is_directory(file, error);
}

LoadedScene load_here(const std::filesystem::path& file, const SceneRequest& asked) {
    now_doing("reading " + file.string());
    if (is_folder(file)) return load_sdf(file, asked.sdf);
    const std::string extension = extension_of(file);
    if (extension == ".world" && is_stage(beginning_of(file))) return load_stage(file);
    // Gazebo once kept its models in files called .model.
    constexpr std::array<std::string_view, 4> of_gazebo{".sdf", ".world", ".urdf", ".model"};
    if (std::ranges::find(of_gazebo, extension) != of_gazebo.end()) {
        return load_sdf(file, asked.sdf);
    }
    if (extension == ".xacro") return load_xacro(file, asked.sdf);
    if (extension == ".xml") return load_mvsim(file, asked.map);
    if (extension == ".yaml" || extension == ".yml") return load_ros_map(file, asked.map);
    if (is_mesh_file(file)) return load_mesh_scene(file, asked.sdf.mesh);
    throw LoadError(
        {file.string() +
         ": is no kind of world that is known; name an SDF (.sdf, .world, .model), a URDF (.urdf, "
         ".xacro), a world of Stage (.world) or MVSim (.xml), a ROS map (.yaml, .yml) or a mesh "
         "(.obj, .stl, .ply, .dae, .gltf, .glb), or the folder of a model"});
}

std::string millimetres(double value_m) {
    const double value_mm = 1e3 * value_m;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), value_mm < 10.0 ? "%.2g mm" : "%.0f mm", value_mm);
    return text.data();
}

void warn_of_coarseness(LoadedScene& loaded, const std::filesystem::path& file) {
    const Scene& scene = *loaded.scene;
    const auto worst = coarsest(scene);
    if (!worst) return;
    const glm::dvec3& at_m = scene.anchor_m;
    std::array<char, 300> figures{};
    std::snprintf(figures.data(), figures.size(),
                  " reaches %.0f m from (%.0f %.0f %.0f), where most of the world lies; ranges out "
                  "there may be wrong by %s, within 1 km of that point by less than 0.1 mm",
                  worst->distance_m, at_m.x, at_m.y, at_m.z, millimetres(worst->error_m).c_str());
    loaded.warnings.push_back(file.string() + ": " + scene.objects[worst->object].name +
                              figures.data());
}

LoadedScene read_world(const std::filesystem::path& file, const SceneRequest& asked) {
    LoadedScene loaded = load_here(file, asked);
    // Robots that come later may have other arguments.
    if (extension_of(file) == ".xacro")
        std::ranges::move(ignored_arguments(file, asked.sdf.xacro),
                          std::back_inserter(loaded.warnings));
    warn_of_coarseness(loaded, file);
    check_overlap(*loaded.scene, *loaded.scene, file.string(), asked.most_overlap);
    return loaded;
}

LoadedScene read_model(const NewModel& model, SceneRequest asked) {
    asked.sdf = within_a_models_share(asked.sdf);
    const Placement& placement = model.placement;
    if (!model.text.empty()) return load_model_text(model.text, placement, model.folder, asked.sdf);
    const std::filesystem::path file = asked.file();
    if (!model.mesh.empty() || is_mesh_file(file)) {
        return load_mesh_model(file, placement, model.scale, model.material, asked.sdf.mesh);
    }
    if (model.scale != 1.0 || !model.material.empty()) {
        throw LoadError(
            {file.string() + ": is no mesh, which scale and material go with; it has its own"});
    }
    return as_model(load_here(file, asked), placement, file.string());
}

}  // namespace

LoadedScene read_scene(const SceneRequest& request) {
    if (const auto* world = std::get_if<SceneRequest::World>(&request.wanted))
        return read_world(*world, request);
    return read_model(std::get<NewModel>(request.wanted), request);
}

}  // namespace scipd::sim
