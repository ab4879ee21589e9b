// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/known_world.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "sim/backends/embree.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/materials/materials_file.h"
#include "sim/loaders/scene_file.h"
#include "sim/world/reflection.h"
#include "tools/options.h"

namespace scipd::tools {
namespace {

/// The face that a beam in this direction meets there; nothing where that lies nearly flat.
std::optional<FaceLine> face_at(const FlatPose& place, double direction_rad, double range_mm,
                                const glm::vec3& normal) {
    constexpr double flattest = 0.3;
    const double upright = std::hypot(double{normal.x}, double{normal.y});
    if (upright < flattest) return std::nullopt;
    double normal_rad = std::atan2(double{normal.y}, double{normal.x});
    if (std::cos(direction_rad - normal_rad) < 0.0) normal_rad += std::numbers::pi;
    const double x_mm = place.x_mm + range_mm * std::cos(direction_rad);
    const double y_mm = place.y_mm + range_mm * std::sin(direction_rad);
    return FaceLine{normal_rad, std::cos(normal_rad) * x_mm + std::sin(normal_rad) * y_mm};
}

sim::SharedScene load(const std::filesystem::path& file,
                      const std::vector<std::filesystem::path>& models) {
    try {
        return sim::load_scene(file, {.sdf = {.model_folders = models}}).scene;
    } catch (const sim::LoadError& error) {
        throw WrongInput(error.what());
    }
}

}  // namespace

KnownWorld::KnownWorld(sim::SharedScene scene, sim::MaterialLibrary materials)
    : backend_(sim::make_embree_backend(std::move(scene))), materials_(std::move(materials)) {}

Sights KnownWorld::look(const Standing& standing, const std::vector<FlatPose>& places) {
    Sights sights;
    for (std::size_t station = 0; station < standing.stations.size(); ++station)
        look_from(standing, station, places[station], sights);
    return sights;
}

void KnownWorld::look_from(const Standing& standing, std::size_t station, const FlatPose& place,
                           Sights& sights) {
    std::vector<Sight> seen = sights_of(standing, station);
    std::vector<glm::vec3> directions;
    for (const Sight& sight : seen)
        directions.emplace_back(std::cos(sight.angle_rad), std::sin(sight.angle_rad), 0.0);
    const sim::Pose pose = sim::pose_from_rpy(
        {place.x_mm / 1000.0, place.y_mm / 1000.0, place.z_mm / 1000.0}, {0.0, 0.0, place.yaw_rad});
    std::vector<sim::Hit> hits(seen.size());
    std::vector<glm::vec3> normals(seen.size());
    backend_->cast({.directions = directions, .world_from_sensor = std::span(&pose, 1)}, hits,
                   normals);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (!hits[i].met()) continue;
        const auto face =
            face_at(place, place.yaw_rad + seen[i].angle_rad, 1000.0 * hits[i].range_m, normals[i]);
        if (!face) continue;
        seen[i].face = sights.faces.size();
        seen[i].surface = hits[i].object;
        sights.faces.push_back(*face);
        sights.list.push_back(seen[i]);
    }
}

const std::string& KnownWorld::name_of(std::size_t surface) const {
    return backend_->scene().objects[surface].name;
}

double KnownWorld::brightness_of(std::size_t surface, int wavelength_nm) const {
    const sim::Scene& scene = backend_->scene();
    const sim::Material& material = scene.materials[scene.objects[surface].material];
    return sim::returned_share(materials_.surface(material, wavelength_nm), 1.0);
}

KnownWorld load_known_world(const std::filesystem::path& file,
                            const std::vector<std::filesystem::path>& models,
                            const std::filesystem::path& materials) {
    sim::MaterialLibrary library;
    if (!materials.empty()) {
        for (sim::MaterialOptics& material : sim::load_materials(materials))
            library.add(std::move(material));
    }
    return KnownWorld(load(file, models), std::move(library));
}

}  // namespace scipd::tools
