// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_scene.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include <sdf/Element.hh>
#include <sdf/Link.hh>
#include <sdf/Mesh.hh>
#include <sdf/Model.hh>
#include <sdf/World.hh>

#include "sim/loaders/load_error.h"
#include "sim/loaders/mesh/mesh_shelf.h"
#include "sim/loaders/name.h"
#include "sim/loaders/sdf/scene_draft.h"
#include "sim/loaders/sdf/sdf_document.h"
#include "sim/loaders/sdf/sdf_frames.h"
#include "sim/loaders/sdf/sdf_place.h"
#include "sim/loaders/sdf/sdf_shape.h"
#include "sim/loaders/sdf/sdf_surface.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

std::string text_of(const glm::dvec3& xyz_m) {
    std::array<char, 100> text{};
    std::snprintf(text.data(), text.size(), "%g %g %g", xyz_m.x, xyz_m.y, xyz_m.z);
    return text.data();
}

/// To where a saved world has it.
Place moved_to(const Place& outer, const SdfState::Entry& saved) {
    const Pose outer_from_here = inverse(outer.world_from_here) * saved.world_from_here;
    return {outer.body, outer.body_from_here * outer_from_here, saved.world_from_here};
}

bool says_not_static(const sdf::Model& model) {
    return !model.Static() && model.Element()->HasElement("static");
}

/// Walks from the root to the surfaces.
class SceneWalk {
  public:
    SceneWalk(SdfFile read, fs::path file, const Resources& resources, SdfOptions options,
              MeshShelf& shelf)
        : read_(std::move(read)),
          file_(std::move(file)),
          resources_(resources),
          options_(std::move(options)),
          draft_(file_, options_.strict, std::move(read_.warnings)),
          shelf_(shelf) {}

    LoadedScene run() &&;

  private:
    void add_root();
    void add_model(const sdf::Model& model);
    /// Short enough.
    std::string name_of(const sdf::Model& model);
    void add_parts(const sdf::Model& model, const Place& place, const std::string& name);
    void add_nested(const sdf::Model& model, const Place& outer, const std::string& outer_name);
    void add_link(const sdf::Link& link, const Place& place, const std::string& name);
    void add_surface(const SdfSurface& surface, const Place& link, const std::string& link_name);
    void add_shape(const SdfSurface& surface, Object object, const std::string& place);
    void add_mesh(const SdfSurface& surface, const sdf::Mesh& mesh, Object object,
                  const std::string& place);
    void leave_out_missing(const sdf::Mesh& mesh, const fs::path& folder, const std::string& place);
    void warn_of_unseen(const sdf::Link& link, const std::string& name);
    std::optional<Place> place_of(const Place& outer, const sdf::SemanticPose& pose,
                                  const sdf::ElementPtr& element, const std::string& name);

    SdfFile read_;
    fs::path file_;
    const Resources& resources_;
    SdfOptions options_;
    SceneDraft draft_;
    std::set<std::string> warned_kinds_;
    std::set<std::string> told_;  ///< downloads, by their commands
    MeshShelf& shelf_;
    glm::dvec3 scale_{1.0};  ///< of the model whose links are looked at
};

LoadedScene SceneWalk::run() && {
    add_root();
    const bool visual = options_.geometry == SdfGeometry::visual;
    return std::move(draft_).finish(visual ? "<visual>" : "<collision>");
}

void SceneWalk::add_root() {
    if (const auto* model = read_.root.Model()) {
        draft_.set_name(model->Name());
        return add_model(*model);
    }
    const auto* world = read_.root.WorldByIndex(0);
    if (world == nullptr) {
        draft_.refuse(file_.string() + ": holds no <world>, and no <model> with a <link>");
        return;
    }
    draft_.set_name(world->Name());
    if (read_.root.WorldCount() > 1) {
        draft_.warn(file_.string() + ": holds several worlds; only the first, '" + world->Name() +
                    "', is used");
    }
    for (std::uint64_t i = 0; i < world->ModelCount(); ++i)
        add_model(*world->ModelByIndex(i));
    if (auto warning = read_.state.unused(file_); !warning.empty()) {
        draft_.warn(std::move(warning));
    }
}

void SceneWalk::add_model(const sdf::Model& model) {
    const std::string name = name_of(model);
    if (read_.state.deleted.contains(shown(name))) return;
    const auto place = place_of({}, model.SemanticPose(), model.Element(), name);
    if (!place) return;
    const Pose& world_from_model = place->world_from_here;
    const ModelId id = draft_.add(Model{name, !model.Static(), world_from_model});
    add_parts(model, {id, {}, world_from_model}, name);
}

std::string SceneWalk::name_of(const sdf::Model& model) {
    std::string name = short_name(model.Name());
    if (name != model.Name()) {
        draft_.warn(read_.place_of(model.Element(), file_) + ": the name has more than " +
                    std::to_string(longest_name) + " bytes; the model is called " + name);
    }
    return name;
}

void SceneWalk::add_parts(const sdf::Model& model, const Place& place, const std::string& name) {
    const auto* saved = read_.state.use(shown(name));
    scale_ = saved == nullptr ? glm::dvec3{1.0} : saved->scale;
    ModelPlaces places{place, {}};
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
        const auto& link = *model.LinkByIndex(i);
        const auto link_name = name + "::" + link.Name();
        const auto here = place_of(place, link.SemanticPose(), link.Element(), link_name);
        if (!here) continue;
        add_link(link, *here, link_name);
        places.links[link.Name()] = *here;
    }
    for (Frame& frame : frames_of(model, places, name, read_.sensors))
        draft_.add(std::move(frame));
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i)
        add_nested(*model.ModelByIndex(i), place, name);
}

void SceneWalk::add_nested(const sdf::Model& model, const Place& outer,
                           const std::string& outer_name) {
    const auto name = outer_name + "::" + name_of(model);
    auto place = place_of(outer, model.SemanticPose(), model.Element(), name);
    if (!place) return;
    if (!draft_.model(outer.body).movable && says_not_static(model)) {
        const ModelId id = draft_.add(Model{name, true, place->world_from_here});
        place = {id, {}, place->world_from_here};
    }
    draft_.add(Frame{name, place->body, place->body_from_here, {}, {}});
    add_parts(model, *place, name);
}

void SceneWalk::add_link(const sdf::Link& link, const Place& place, const std::string& name) {
    draft_.add(Frame{name, place.body, place.body_from_here, {}, {}});
    for (const SdfSurface& surface : surfaces_of(link, options_.geometry))
        add_surface(surface, place, name);
    warn_of_unseen(link, name);
}

void SceneWalk::warn_of_unseen(const sdf::Link& link, const std::string& name) {
    const bool visual = options_.geometry == SdfGeometry::visual;
    const auto seen = visual ? link.VisualCount() : link.CollisionCount();
    const auto unseen = visual ? link.CollisionCount() : link.VisualCount();
    if (seen > 0 || unseen == 0) return;
    draft_.warn(read_.place_of(link.Element(), file_) + ": " + name +
                (visual ? " has collisions but no visual; scanners see visuals only"
                        : " has visuals but no collision; scanners see collisions only"));
}

void SceneWalk::add_surface(const SdfSurface& surface, const Place& link,
                            const std::string& link_name) {
    Object object;
    object.name = link_name + "::" + surface.name;
    object.model = link.body;
    if (surface.geometry == nullptr || kind_of(*surface.geometry) == "empty") return;
    const auto here = place_of(link, surface.pose, surface.element, object.name);
    if (!here) return;
    object.model_from_object = here->body_from_here;
    const auto place = read_.place_of(surface.element, file_) + ": " + object.name + ": ";
    if (surface.laser_retro && !std::isfinite(*surface.laser_retro)) {
        return draft_.leave_out(place + "laser_retro must be finite");
    }
    try {
        if (const auto* mesh = surface.geometry->MeshShape()) {
            return add_mesh(surface, *mesh, std::move(object), place);
        }
        add_shape(surface, std::move(object), place);
    } catch (const LoadError& error) {
        for (const auto& fault : error.faults())
            draft_.leave_out(place + fault);
    }
}

void SceneWalk::add_shape(const SdfSurface& surface, Object object, const std::string& place) {
    const auto primitive = primitive_of(*surface.geometry);
    if (!primitive) {
        const auto kind = kind_of(*surface.geometry);
        if (!warned_kinds_.insert(kind).second) return;
        return draft_.pass_over(place + '<' + kind +
                                "> is not supported and left out, here and elsewhere");
    }
    const auto larger = scaled(primitive->shape, scale_);
    if (!larger) {
        draft_.warn(place +
                    "keeps its size, as in Gazebo: the scale in <state> is for boxes, "
                    "cylinders, spheres and meshes");
    }
    object.shape = larger ? *larger : primitive->shape;
    shelf_.count(object.shape);
    object.model_from_object = object.model_from_object * primitive->geometry_from_shape;
    draft_.add(std::move(object), {surface.material, surface.laser_retro});
}

/// Of a download, the first time only.
void SceneWalk::leave_out_missing(const sdf::Mesh& mesh, const fs::path& folder,
                                  const std::string& place) {
    const auto command = download_command(mesh.Uri());
    if (!command.empty() && !told_.insert(command).second) return;
    // What the library has in place of none.
    const bool has_uri = mesh.Uri() != "__default__";
    const auto uri = has_uri ? read_.uri_as_written(mesh.Element(), mesh.Uri()) : "";
    draft_.leave_out(place + resources_.not_found(uri, folder));
}

void SceneWalk::add_mesh(const SdfSurface& surface, const sdf::Mesh& mesh, Object object,
                         const std::string& place) {
    const auto file = read_.file_of(mesh.Element(), file_);
    // A text is called by a name, and lies in no folder.
    const auto folder = file.is_absolute() ? file.parent_path() : resources_.folder();
    const auto found = resources_.find(mesh.Uri(), folder);
    if (found.empty()) return leave_out_missing(mesh, folder, place);
    if (auto warning = case_warning(mesh.Uri(), found); !warning.empty()) {
        draft_.warn(place + warning);
    }
    sdf::Mesh larger = mesh;
    larger.SetScale(mesh.Scale() * ignition::math::Vector3d{scale_.x, scale_.y, scale_.z});
    for (const auto& part : shelf_.parts_of(found, larger)) {
        object.shape = part.mesh;
        draft_.add(object, {surface.material.empty() ? part.material : surface.material,
                            surface.laser_retro});
    }
}

/// What lies in `outer` at this pose; nothing where it cannot lie there.
std::optional<Place> SceneWalk::place_of(const Place& outer, const sdf::SemanticPose& pose,
                                         const sdf::ElementPtr& element, const std::string& name) {
    const auto where = read_.place_of(element, file_) + ": " + name + ": ";
    ignition::math::Pose3d resolved;
    if (const auto errors = pose.Resolve(resolved); !errors.empty()) {
        draft_.leave_out(where + errors.front().Message());
        return {};
    }
    Place here = outer * to_pose(resolved);
    if (const auto* saved = read_.state.use(shown(name))) here = moved_to(outer, *saved);
    const auto& [at_m, rotation] = here.world_from_here;
    if (plausible_position(at_m) && std::isfinite(glm::length(rotation))) return here;
    draft_.leave_out(where + "lies at " + text_of(at_m) +
                     "; everything must lie within 1e7 m of the origin");
    return {};
}

}  // namespace

LoadedScene scene_of(SdfFile read, const fs::path& source, const Resources& resources,
                     const SdfOptions& options, MeshShelf& shelf) {
    return SceneWalk{std::move(read), source, resources, options, shelf}.run();
}

}  // namespace scipd::sim
