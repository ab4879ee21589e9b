// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_scene.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include <sdf/Element.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/World.hh>

#include "sim/loaders/sdf/actor_model.h"
#include "sim/loaders/sdf/actor_skin.h"
#include "sim/loaders/sdf/scene_draft.h"
#include "sim/loaders/sdf/scene_shapes.h"
#include "sim/loaders/sdf/sdf_document.h"
#include "sim/loaders/sdf/sdf_frames.h"
#include "sim/loaders/sdf/sdf_place.h"
#include "sim/loaders/sdf/sdf_shape.h"
#include "sim/loaders/sdf/sdf_surface.h"
#include "sim/text/name.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

std::string xyz_text(const glm::dvec3& xyz_m) {
    std::array<char, 100> text{};
    std::snprintf(text.data(), text.size(), "%g %g %g", xyz_m.x, xyz_m.y, xyz_m.z);
    return text.data();
}

/// The place that a saved world gives it.
Place moved_to(const Place& outer, const SdfState::Entry& saved) {
    const Pose outer_from_here = inverse(outer.world_from_here) * saved.world_from_here;
    return {outer.body, outer.body_from_here * outer_from_here, saved.world_from_here};
}

bool says_not_static(const sdf::Model& model) {
    return !model.Static() && model.Element()->HasElement("static");
}

bool has_shape(const SdfSurface& surface) {
    return surface.geometry != nullptr && kind_of(*surface.geometry) != "empty";
}

bool says_empty(const SdfSurface& surface) {
    const auto element = surface.geometry == nullptr ? nullptr : surface.geometry->Element();
    return element && element->HasElement("empty");
}

/// Walks through the document, from the root to the surfaces.
class SceneWalk {
  public:
    SceneWalk(SdfFile read, fs::path file, const Resources& resources, SdfOptions options,
              MeshShelf& shelf)
        : read_(std::move(read)),
          file_(std::move(file)),
          options_(std::move(options)),
          draft_(file_, options_.strict, std::move(read_.warnings)),
          shapes_(read_, file_, resources, options_, draft_, shelf) {}

    LoadedScene run() &&;

  private:
    void add_root();
    void add_model(const sdf::Model& model);
    /// The model's name, cut to the longest that is allowed.
    std::string name_of(const sdf::Model& model);
    void add_parts(const sdf::Model& model, const Place& place, const std::string& name);
    void add_nested(const sdf::Model& model, const Place& outer, const std::string& outer_name);
    void add_link(const sdf::Link& link, const Place& place, const std::string& name);
    void add_surface(const SdfSurface& surface, const Place& link, const std::string& link_name);
    void warn_of_unseen(const sdf::Link& link, const std::string& name);
    std::optional<Place> place_of(const Place& outer, const sdf::SemanticPose& pose,
                                  const sdf::ElementPtr& element, const std::string& name);

    SdfFile read_;
    fs::path file_;
    SdfOptions options_;
    SceneDraft draft_;
    SceneShapes shapes_;
    const SdfActor* actor_ = nullptr;  ///< of the current model; null: none
    glm::dvec3 scale_{1.0};            ///< of the model whose links are being read
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
    if (read_.state.deleted.contains(as_in_file(name))) return;
    const auto place = place_of({}, model.SemanticPose(), model.Element(), name);
    if (!place) return;
    actor_ = actor_of(model, read_.actors);
    const Model still{name, !model.Static(), place->world_from_here};
    const ModelId id = draft_.add(actor_ == nullptr ? still : walking(still, *actor_, model));
    add_parts(model, {id, {}, place->world_from_here}, name);
    actor_ = nullptr;
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
    const auto* saved = read_.state.use(as_in_file(name));
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
    const auto place = read_.place_of(surface.element, file_) + ": " + object.name + ": ";
    if (!has_shape(surface)) {
        // Gazebo shows nothing here either. Only <empty> is meant to be empty; all else gets a
        // warning.
        if (!says_empty(surface)) draft_.leave_out(place + "has no <geometry> with a shape");
        return;
    }
    const auto here = place_of(link, surface.pose, surface.element, object.name);
    if (!here) return;
    object.model_from_object = here->body_from_here;
    if (surface.laser_retro && !std::isfinite(*surface.laser_retro)) {
        return draft_.leave_out(place + "laser_retro must be finite");
    }
    if (actor_ != nullptr && surface.name == skin_name) {
        return shapes_.add_skin(surface, std::move(object), scale_, place);
    }
    shapes_.add(surface, std::move(object), scale_, place);
}

/// The place at this pose in `outer`; nothing, with a warning, if it cannot be resolved or is too
/// far.
std::optional<Place> SceneWalk::place_of(const Place& outer, const sdf::SemanticPose& pose,
                                         const sdf::ElementPtr& element, const std::string& name) {
    const auto where = read_.place_of(element, file_) + ": " + name + ": ";
    ignition::math::Pose3d resolved;
    if (const auto errors = pose.Resolve(resolved); !errors.empty()) {
        draft_.leave_out(where + errors.front().Message());
        return {};
    }
    Place here = outer * to_pose(resolved);
    if (const auto* saved = read_.state.use(as_in_file(name))) here = moved_to(outer, *saved);
    const auto& [at_m, rotation] = here.world_from_here;
    if (plausible_position(at_m) && std::isfinite(glm::length(rotation))) return here;
    draft_.leave_out(where + "lies at " + xyz_text(at_m) +
                     "; everything must lie within 1e7 m of the origin");
    return {};
}

}  // namespace

LoadedScene scene_of(SdfFile read, const fs::path& source, const Resources& resources,
                     const SdfOptions& options, MeshShelf& shelf) {
    return SceneWalk{std::move(read), source, resources, options, shelf}.run();
}

}  // namespace scipd::sim
