// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/scene_shapes.h"

#include <utility>

#include "sim/loaders/actors/actor_skin.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/sdf/sdf_geometry.h"
#include "sim/loaders/terrain/terrain.h"

namespace scipd::sim {
namespace {

MeshView larger(MeshView view, const glm::dvec3& scale) {
    view.scale *= scale;
    return view;
}

/// What the visual says comes before what the mesh says, and if it names a material the mesh's own
/// does not count at all.
Material material_of(const SdfSurface& surface, const SharedPart& part) {
    Material material{surface.material, surface.laser_retro, surface.appearance,
                      surface.from_script};
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
    const Geometry& geometry = surface.geometry;
    try {
        if (const auto* unread = std::get_if<Unread>(&geometry)) {
            draft_.leave_out(place + unread->why);
        } else if (const auto* unknown = std::get_if<UnknownShape>(&geometry)) {
            if (!warned_kinds_.insert(unknown->kind).second) return;
            draft_.pass_over(place + '<' + unknown->kind +
                             "> is not supported and left out, here and elsewhere");
        } else if (const auto* mesh = std::get_if<NamedMesh>(&geometry)) {
            add_mesh(surface, *mesh, std::move(object), scale, place);
        } else if (const auto* heights = std::get_if<NamedHeights>(&geometry)) {
            add_shape(surface, terrain_in(*heights, place), std::move(object), scale, place);
        } else {
            add_shape(surface, std::get<PlacedShape>(geometry), std::move(object), scale, place);
        }
    } catch (const LoadError& error) {
        for (const auto& fault : error.faults())
            draft_.leave_out(place + fault);
    }
}

void SceneShapes::add_shape(const SdfSurface& surface, const PlacedShape& primitive, Object object,
                            const glm::dvec3& scale, const std::string& place) {
    const auto larger = scaled(primitive.shape, scale);
    if (!larger) {
        draft_.warn(place +
                    "keeps its size, as in Gazebo: the scale in <state> is for boxes, "
                    "cylinders, spheres and meshes");
    }
    object.shape = larger ? *larger : primitive.shape;
    shelf_.count(object.shape);
    object.model_from_object = object.model_from_object * primitive.geometry_from_shape;
    draft_.add(std::move(object),
               {surface.material, surface.laser_retro, surface.appearance, surface.from_script});
}

/// A missing download is reported only once.
void SceneShapes::leave_out_missing(const NamedFile& file, const std::string& place) {
    const auto command = download_command(file.uri);
    if (!command.empty() && !told_.insert(command).second) return;
    draft_.leave_out(place + resources_.not_found(file.uri, file.folder));
}

PlacedShape SceneShapes::terrain_in(const NamedHeights& heights, const std::string& place) {
    const auto& [uri, folder] = heights.file;
    const auto found = resources_.find(uri, folder);
    if (found.empty()) throw LoadError({resources_.not_found(uri, folder)});
    const auto terrain = terrain_of(found, heights.view, options_.mesh.triangles);
    for (const auto& remark : terrain.remarks)
        draft_.warn(place + remark);
    return {terrain.surface, {terrain.position_m}};
}

void SceneShapes::add_mesh(const SdfSurface& surface, const NamedMesh& mesh, Object object,
                           const glm::dvec3& scale, const std::string& place) {
    const auto& [uri, folder] = mesh.file;
    const auto found = resources_.find(uri, folder);
    if (found.empty()) return leave_out_missing(mesh.file, place);
    if (auto warning = case_warning(uri, found); !warning.empty()) draft_.warn(place + warning);
    for (const auto& part : shelf_.parts_of(found, larger(mesh.view, scale))) {
        object.shape = part.mesh;
        draft_.add(object, material_of(surface, part));
    }
}

void SceneShapes::add_skin(const SdfSurface& surface, Object object, const glm::dvec3& scale,
                           const std::string& place) {
    const double z_m = draft_.model(object.model).world_from_model.translation_m.z;
    const auto& [file, view] = std::get<NamedMesh>(surface.geometry);
    const ActorSkin skin = skin_of(file, larger(view, scale), resources_, shelf_, z_m);
    if (!skin.warning.empty()) draft_.warn(place + skin.warning);
    object.model_from_object.translation_m.z += skin.lift_m;
    for (const SharedPart& part : skin.parts) {
        object.shape = part.mesh;
        draft_.add(object, {part.material, {}, part.appearance});
    }
}

}  // namespace scipd::sim
