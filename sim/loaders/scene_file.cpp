// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/scene_file.h"

#include <string>

#include "sim/loaders/load_error.h"
#include "sim/loaders/mesh/mesh_file.h"
#include "sim/loaders/mesh/mesh_scene.h"
#include "sim/loaders/sdf/xacro.h"

namespace scipd::sim {

namespace {

LoadedScene load_here(const std::filesystem::path& file, const SceneOptions& options) {
    const std::string extension = extension_of(file);
    if (extension == ".sdf" || extension == ".world" || extension == ".urdf") {
        return load_sdf(file, options.sdf);
    }
    if (extension == ".xacro") return load_xacro(file, options.sdf);
    if (extension == ".yaml" || extension == ".yml") return load_ros_map(file, options.map);
    if (is_mesh_file(file)) return load_mesh_scene(file);
    throw LoadError(
        {file.string() +
         ": is no kind of world that is known; name an SDF (.sdf, .world), a URDF "
         "(.urdf, .xacro), a ROS map (.yaml, .yml) or a mesh (.obj, .stl, .ply, .dae, .gltf, "
         ".glb)"});
}

}  // namespace

LoadedScene load_scene(const std::filesystem::path& file, const SceneOptions& options) {
    return load_confined(file.string(), options.limits, [&] {
        LoadedScene loaded = load_here(file, options);
        if (options.sdf.strict && !loaded.warnings.empty()) throw LoadError(loaded.warnings);
        return loaded;
    });
}

}  // namespace scipd::sim
