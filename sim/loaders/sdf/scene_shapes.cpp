// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/scene_shapes.h"

#include <utility>

#include <sdf/Heightmap.hh>
#include <sdf/Mesh.hh>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/sdf/actor_skin.h"
#include "sim/loaders/sdf/sdf_document.h"
#include "sim/loaders/sdf/sdf_heightmap.h"

namespace scipd::sim {

namespace fs = std::filesystem;

namespace {

sdf::Mesh larger(const sdf::Mesh& mesh, const glm::dvec3& scale) {
    sdf::Mesh result = mesh;
    result.SetScale(mesh.Scale() * ignition::math::Vector3d{scale.x, scale.y, scale.z});
    return result;
}

/// What the visual says comes before what the mesh says, and if it names a material the mesh's own
/// does not count at all.
Material material_of(const SdfSurface& surface, const SharedPart& part) {
    Material material{surface.material, surface.laser_retro, surface.appearance};
    if (!material.name.empty()) return material;
    material.name = part.material;
    Appearance& seen = material.appearance;
    if (!seen.transparency) seen.transparency = part.appearance.transparency;
    if (seen.metalness) return material;
    seen.metalness = part.appearance.metalness;
    seen.roughness = part.appearance.roughness;
    return material;
}

}  // namespace

void SceneShapes::add(const SdfSurface& surface, Object object, const glm::dvec3& scale,
                      const std::string& place) {
    try {
        if (const auto* mesh = surface.geometry->MeshShape()) {
            return add_mesh(surface, *mesh, std::move(object), scale, place);
        }
        add_shape(surface, std::move(object), scale, place);
    } catch (const LoadError& error) {
        for (const auto& fault : error.faults())
            draft_.leave_out(place + fault);
    }
}

void SceneShapes::add_shape(const SdfSurface& surface, Object object, const glm::dvec3& scale,
                            const std::string& place) {
    const auto primitive = shape_of(*surface.geometry, place);
    if (!primitive) {
        const auto kind = kind_of(*surface.geometry);
        if (!warned_kinds_.insert(kind).second) return;
        return draft_.pass_over(place + '<' + kind +
                                "> is not supported and left out, here and elsewhere");
    }
    const auto larger = scaled(primitive->shape, scale);
    if (!larger) {
        draft_.warn(place +
                    "keeps its size, as in Gazebo: the scale in <state> is for boxes, "
                    "cylinders, spheres and meshes");
    }
    object.shape = larger ? *larger : primitive->shape;
    shelf_.count(object.shape);
    object.model_from_object = object.model_from_object * primitive->geometry_from_shape;
    draft_.add(std::move(object), {surface.material, surface.laser_retro, surface.appearance});
}

/// A missing download is reported only once.
void SceneShapes::leave_out_missing(const sdf::Mesh& mesh, const fs::path& folder,
                                    const std::string& place) {
    const auto command = download_command(mesh.Uri());
    if (!command.empty() && !told_.insert(command).second) return;
    // The library's URI for a mesh that has none.
    const bool has_uri = mesh.Uri() != "__default__";
    const auto uri = has_uri ? read_.uri_as_written(mesh.Element(), mesh.Uri()) : "";
    draft_.leave_out(place + resources_.not_found(uri, folder));
}

std::optional<PlacedShape> SceneShapes::shape_of(const sdf::Geometry& geometry,
                                                 const std::string& place) {
    const auto* heightmap = geometry.HeightmapShape();
    if (heightmap == nullptr) return primitive_of(geometry);
    const auto folder = folder_of(heightmap->Element());
    const auto found = resources_.find(heightmap->Uri(), folder);
    if (found.empty()) throw LoadError({resources_.not_found(heightmap->Uri(), folder)});
    const auto terrain = terrain_of(*heightmap, found, options_.mesh.triangles);
    for (const auto& remark : terrain.remarks)
        draft_.warn(place + remark);
    return terrain.surface;
}

fs::path SceneShapes::folder_of(const sdf::ElementPtr& element) const {
    const auto file = read_.file_of(element, file_);
    // A text has only a name, not a folder.
    return file.is_absolute() ? file.parent_path() : resources_.folder();
}

void SceneShapes::add_mesh(const SdfSurface& surface, const sdf::Mesh& mesh, Object object,
                           const glm::dvec3& scale, const std::string& place) {
    const auto folder = folder_of(mesh.Element());
    const auto found = resources_.find(mesh.Uri(), folder);
    if (found.empty()) return leave_out_missing(mesh, folder, place);
    if (auto warning = case_warning(mesh.Uri(), found); !warning.empty()) {
        draft_.warn(place + warning);
    }
    for (const auto& part : shelf_.parts_of(found, larger(mesh, scale))) {
        object.shape = part.mesh;
        draft_.add(object, material_of(surface, part));
    }
}

void SceneShapes::add_skin(const SdfSurface& surface, Object object, const glm::dvec3& scale,
                           const std::string& place) {
    const auto& mesh = *surface.geometry->MeshShape();
    const double z_m = draft_.model(object.model).world_from_model.translation_m.z;
    const ActorSkin skin =
        skin_of(larger(mesh, scale), folder_of(mesh.Element()), resources_, shelf_, z_m);
    if (!skin.warning.empty()) draft_.warn(place + skin.warning);
    object.model_from_object.translation_m.z += skin.lift_m;
    for (const SharedPart& part : skin.parts) {
        object.shape = part.mesh;
        draft_.add(object, {part.material, {}, part.appearance});
    }
}

}  // namespace scipd::sim
