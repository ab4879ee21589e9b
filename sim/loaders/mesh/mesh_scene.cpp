// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh/mesh_scene.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <glm/common.hpp>

#include "sim/loaders/mesh/mesh_parts.h"
#include "sim/world/anchor.h"
#include "sim/world/bounds.h"

namespace scipd::sim {
namespace {

/// Beyond this distance a float is coarser than a millimetre.
constexpr double coarse_m = 10'000.0;

double reach_m(const Scene& scene) {
    double reach_m = 0.0;
    for (const Object& object : scene.objects) {
        const Bounds bounds = bounds_of(object.shape);
        const glm::dvec3 most = glm::max(glm::abs(bounds.low_m), glm::abs(bounds.high_m));
        reach_m = std::max({reach_m, most.x, most.y, most.z});
    }
    return reach_m;
}

}  // namespace

LoadedScene load_mesh_scene(const std::filesystem::path& given, const MeshLimits& limits) {
    const auto file = std::filesystem::absolute(given).lexically_normal();
    Scene scene;
    scene.name = file.stem().string();
    scene.models.push_back({scene.name, false, {}});
    for (MeshPart& part : load_mesh_parts(file, {1.0, 1.0, 1.0}, MeshAxes::z_up, limits)) {
        const MaterialId material =
            id_of({.name = part.material, .appearance = part.appearance}, scene.materials);
        scene.objects.push_back({scene.name + "::" + scene.materials[material].name, 0, Pose{},
                                 std::make_shared<const Mesh>(std::move(part.mesh)), material});
    }
    std::vector<std::string> warnings;
    if (const double far_m = reach_m(scene); far_m > coarse_m) {
        warnings.push_back(file.string() + ": reaches " + std::to_string(std::llround(far_m)) +
                           " m from its origin, where a mesh is coarser than a millimetre; if it "
                           "is in millimetres, show it from an SDF with <scale>0.001 0.001 "
                           "0.001</scale>");
    }
    // Whole metres, so that round coordinates stay round.
    scene.anchor_m = anchor_of(scene);
    return {std::make_shared<const Scene>(std::move(scene)), std::move(warnings)};
}

}  // namespace scipd::sim
