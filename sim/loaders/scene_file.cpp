// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/scene_file.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <string>
#include <string_view>

#include "sim/loaders/file/doing.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/materials/unknown_materials.h"
#include "sim/loaders/mesh/mesh_file.h"
#include "sim/loaders/mesh/mesh_scene.h"
#include "sim/loaders/mvsim/mvsim_scene.h"
#include "sim/loaders/sdf/xacro.h"
#include "sim/loaders/stage/stage_scene.h"
#include "sim/world/anchor.h"
#include "sim/world/overlap.h"

namespace scipd::sim {

namespace {

bool is_folder(const std::filesystem::path& file) {
    std::error_code error;
    return std::filesystem::is_directory(file, error);
}

LoadedScene load_here(const std::filesystem::path& file, const SceneOptions& options) {
    now_doing("reading " + file.string());
    if (is_folder(file)) return load_sdf(file, options.sdf);
    const std::string extension = extension_of(file);
    if (extension == ".world" && is_stage(beginning_of(file))) return load_stage(file);
    // Gazebo once kept its models in files called .model.
    constexpr std::array<std::string_view, 4> of_gazebo{".sdf", ".world", ".urdf", ".model"};
    if (std::ranges::find(of_gazebo, extension) != of_gazebo.end()) {
        return load_sdf(file, options.sdf);
    }
    if (extension == ".xacro") return load_xacro(file, options.sdf);
    if (extension == ".xml") return load_mvsim(file, options.map);
    if (extension == ".yaml" || extension == ".yml") return load_ros_map(file, options.map);
    if (is_mesh_file(file)) return load_mesh_scene(file, options.sdf.mesh);
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

}  // namespace

void check_materials(LoadedScene& loaded, const std::string& source, const SceneOptions& options) {
    bool is_fault = !loaded.warnings.empty();
    if (options.materials) {
        is_fault = is_fault || names_unknown(*loaded.scene, *options.materials);
        std::ranges::move(unknown_materials(*loaded.scene, *options.materials, source),
                          std::back_inserter(loaded.warnings));
    }
    if (options.sdf.strict && is_fault) throw LoadError(loaded.warnings);
}

LoadedScene load_scene(const std::filesystem::path& file, const SceneOptions& options) {
    return load_confined(file.string(), options.limits, [&] {
        LoadedScene loaded = load_here(file, options);
        warn_of_coarseness(loaded, file);
        check_materials(loaded, file.string(), options);
        check_overlap(*loaded.scene, *loaded.scene, file.string(), options);
        return loaded;
    });
}

void check_overlap(const Scene& scene, const Scene& added, const std::string& source,
                   const SceneOptions& options) {
    const auto worst = worst_overlap(scene, added, double(options.most_overlap));
    if (!worst) return;
    const glm::dvec3& at_m = worst->middle_m;
    std::array<char, 400> text{};
    std::snprintf(text.data(), text.size(),
                  ": near (%.4g %.4g %.4g) so many triangles lie in one place that a ray would be "
                  "tested against %.0f of them, and scans would be lost; take away what is there "
                  "more than once, or thin it out; world_overlap under limits in the "
                  "configuration allows more than %zu",
                  at_m.x, at_m.y, at_m.z, worst->triangles, options.most_overlap);
    throw LoadError({source + ": " + worst->object + text.data()});
}

LoadedScene load_model_file(const std::filesystem::path& file, const Placement& placement,
                            const SceneOptions& options) {
    LoadedScene loaded = load_here(file, options);
    check_materials(loaded, file.string(), options);
    return as_model(std::move(loaded), placement, file.string());
}

std::filesystem::path folder_of_scene(const std::filesystem::path& file) {
    return is_folder(file) ? file : file.parent_path();
}

}  // namespace scipd::sim
