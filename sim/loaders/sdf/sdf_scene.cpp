// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_scene.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

#include "sim/loaders/parts/frames.h"
#include "sim/loaders/sdf/scene_shapes.h"
#include "sim/loaders/sdf/sdf_sensors.h"
#include "sim/loaders/sdf/sdf_world.h"
#include "sim/text/name.h"
#include "sim/text/quote.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

/// Where a link or a nested model lies, and the body that it belongs to.
struct Place {
    ModelId body = 0;
    Pose body_from_here;
    Pose world_from_here;  ///< at load
};

Place operator*(const Place& outer, const Pose& outer_from_here) {
    return {outer.body, outer.body_from_here * outer_from_here,
            outer.world_from_here * outer_from_here};
}

/// The place that a saved world gives it.
Place moved_to(const Place& outer, const SdfState::Entry& saved) {
    const Pose outer_from_here = inverse(outer.world_from_here) * saved.world_from_here;
    return {outer.body, outer.body_from_here * outer_from_here, saved.world_from_here};
}

std::string xyz_text(const glm::dvec3& xyz_m) {
    std::array<char, 100> text{};
    std::snprintf(text.data(), text.size(), "%g %g %g", xyz_m.x, xyz_m.y, xyz_m.z);
    return text.data();
}

bool are_one_place(const Pose& a, const Pose& b) {
    return glm::distance(a.translation_m, b.translation_m) < 1e-3 &&
           angle_between_rad(a.rotation, b.rotation) < 1e-3;
}

/// `still` with the script of the actor, at the first pose of that script. Waypoints are poses in
/// the world, as in Gazebo Classic (gazebo/physics/Actor.cc sets them as world poses). If an
/// include puts the actor elsewhere, they are relative to that place, as in Gazebo Sim
/// (src/rendering/RenderUtil.cc).
Model walking(Model still, const Actor& actor, const Pose& put) {
    still.movable = true;
    if (actor.script == nullptr) return still;
    still.script = are_one_place(put, actor.pose) ? actor.script : moved(put, *actor.script);
    still.world_from_model = still.script->steps.front().pose;
    return still;
}

/// A frame for each, but for models right in a world.
std::size_t count_of_frames(const SdfPart& outer) {
    std::size_t count = outer.parts.size();
    for (const SdfPart& part : outer.parts)
        count += count_of_frames(part);
    return count;
}

/// Walks through the tree, from the root to the surfaces.
class SceneWalk {
  public:
    SceneWalk(SdfTree& tree, const SdfOptions& options, const Resources& resources,
              SceneDraft& draft, MeshShelf& shelf)
        : tree_(tree),
          options_(options),
          draft_(draft),
          shapes_(resources, options, draft, shelf) {}

    void run(const std::filesystem::path& file) {
        draft_.set_name(tree_.root.name);
        draft_.expect_frames(count_of_frames(tree_.root));
        Frames frames(tree_.root);
        for (const SdfPart& model : tree_.root.parts) {
            if (model.kind == SdfPart::Kind::model) add_model(model, frames);
        }
        for (const SdfPart& frame : tree_.root.parts)
            check_frame_of_world(frame, frames);
        if (auto warning = tree_.state.unused(file); !warning.empty()) {
            draft_.warn(warning);
        }
    }

  private:
    void add_model(const SdfPart& model, Frames& world);
    /// The model's name, cut to the longest that is allowed.
    std::string name_of(const SdfPart& model);
    void add_parts(const SdfPart& model, const Place& place, const std::string& name,
                   const std::string& name_in_file);
    void add_nested(const SdfPart& model, Frames& frames, const Place& outer,
                    const std::string& outer_name, const std::string& name_in_file);
    void add_link(const SdfPart& link, Frames& frames, const Place& place, const std::string& name);
    void add_surface(const SdfSurface& surface, const SdfPart& link, Frames& frames,
                     const Place& place, const std::string& link_name);
    void add_frame(const SdfPart& frame, Frames& frames, const Place& model,
                   const std::string& model_name);
    /// Nobody mounts a scanner there, and a mistake in one is told all the same, as in a model.
    void check_frame_of_world(const SdfPart& frame, Frames& world);
    void warn_of_unseen(const SdfPart& link, const std::string& name);
    /// The place at this pose in `outer`; nothing, with a warning, if it cannot be resolved or is
    /// too far.
    std::optional<Place> place_of(const Place& outer, const Expected<Pose>& pose,
                                  const FilePlace& in_file, const std::string& name,
                                  const SdfState::Entry* saved = nullptr);

    SdfTree& tree_;
    const SdfOptions& options_;
    SceneDraft& draft_;
    SceneShapes shapes_;
    const Actor* actor_ = nullptr;                 ///< of the current model; null: none
    glm::dvec3 scale_{1.0};                        ///< of the model whose links are being read
    std::map<const SdfPart*, Place> moved_links_;  ///< by a saved world
};

void SceneWalk::add_model(const SdfPart& model, Frames& world) {
    if (tree_.state.deleted.contains(model.name)) return;
    const std::string name = name_of(model);
    const auto place =
        place_of({}, world.pose_of(model), model.place, name, tree_.state.use(model.name));
    if (!place) return;
    actor_ = model.actor.get();
    const Model still{name, !model.is_static.value_or(false), place->world_from_here};
    const ModelId id =
        draft_.add(actor_ == nullptr ? still : walking(still, *actor_, model.pose.pose));
    add_parts(model, {id, {}, place->world_from_here}, name, model.name);
    actor_ = nullptr;
    draft_.drop_if_bare(id);
}

std::string SceneWalk::name_of(const SdfPart& model) {
    std::string name = short_name(model.name);
    if (name != model.name) {
        draft_.warn(text_of(model.place) + ": the name has more than " +
                    std::to_string(longest_name) + " bytes; the model is called " + name);
    }
    return name;
}

void SceneWalk::add_parts(const SdfPart& model, const Place& place, const std::string& name,
                          const std::string& name_in_file) {
    const auto* saved = tree_.state.use(name_in_file);
    scale_ = saved == nullptr ? glm::dvec3{1.0} : saved->scale;
    Frames frames(model);
    for (const SdfPart& link : model.parts) {
        if (link.kind != SdfPart::Kind::link) continue;
        const auto link_name = name + "::" + link.name;
        const auto* moved = tree_.state.use(name_in_file + "::" + link.name);
        const auto here = place_of(place, frames.pose_of(link), link.place, link_name, moved);
        if (!here) continue;
        add_link(link, frames, *here, link_name);
        if (moved != nullptr) moved_links_[&link] = *here;
    }
    for (const SdfPart& frame : model.parts) {
        if (frame.kind == SdfPart::Kind::frame) add_frame(frame, frames, place, name);
    }
    for (const SdfPart& nested : model.parts) {
        if (nested.kind == SdfPart::Kind::model)
            add_nested(nested, frames, place, name, name_in_file);
    }
}

void SceneWalk::add_nested(const SdfPart& model, Frames& frames, const Place& outer,
                           const std::string& outer_name, const std::string& outer_in_file) {
    const auto name = outer_name + "::" + name_of(model);
    const auto in_file = outer_in_file + "::" + model.name;
    auto place =
        place_of(outer, frames.pose_of(model), model.place, name, tree_.state.use(in_file));
    if (!place) return;
    const bool says_not_static = model.is_static && !*model.is_static;
    if (!draft_.model(outer.body).movable && says_not_static) {
        const ModelId id = draft_.add(Model{name, true, place->world_from_here});
        place = {id, {}, place->world_from_here};
    }
    draft_.add(Frame{name, place->body, place->body_from_here, {}, {}});
    add_parts(model, *place, name, in_file);
}

void SceneWalk::add_link(const SdfPart& link, Frames& frames, const Place& place,
                         const std::string& name) {
    draft_.add(Frame{name, place.body, place.body_from_here, {}, {}});
    for (const SdfSurface& surface : link.surfaces)
        add_surface(surface, link, frames, place, name);
    warn_of_unseen(link, name);
}

void SceneWalk::warn_of_unseen(const SdfPart& link, const std::string& name) {
    const bool visual = options_.geometry == SdfGeometry::visual;
    if (!link.surfaces.empty() || !link.has_unseen) return;
    draft_.warn(text_of(link.place) + ": " + name +
                (visual
                     ? " has collisions but no visual; scanners see visuals only; with geometry: "
                       "collision or --geometry collision they see collisions only"
                     : " has visuals but no collision; scanners see collisions only"));
}

void SceneWalk::add_surface(const SdfSurface& surface, const SdfPart& link, Frames& frames,
                            const Place& place, const std::string& link_name) {
    Object object;
    object.name = link_name + "::" + surface.name;
    object.model = place.body;
    const auto where = text_of(surface.place) + ": " + object.name + ": ";
    if (std::holds_alternative<NoShape>(surface.geometry)) return;
    const auto here =
        place_of(place, frames.in_link(link, surface.pose), surface.place, object.name);
    if (!here) return;
    object.model_from_object = here->body_from_here;
    if (actor_ != nullptr && surface.name == skin_name) {
        return shapes_.add_skin(surface, std::move(object), scale_, where);
    }
    shapes_.add(surface, std::move(object), scale_, where);
}

/// In a saved world it goes with the link that it is fixed to.
void SceneWalk::add_frame(const SdfPart& frame, Frames& frames, const Place& model,
                          const std::string& model_name) {
    const auto pose = frames.pose_of(frame);
    const std::string name = model_name + "::" + frame.name;
    if (!pose) {
        const bool is_lidar = frame.sensor && frame.sensor->lidar;
        if (frame.sensor && !is_lidar) return;
        return draft_.warn(text_of(frame.place) + ": " + name + ": " + pose.error().why +
                           (is_lidar ? no_scanner_there : "; left out"));
    }
    const SdfPart* link = frames.link_under(frame);
    const auto there = moved_links_.find(link);
    const Place here = there == moved_links_.end()
                           ? model * *pose
                           : there->second * (inverse(*frames.pose_of(*link)) * *pose);
    if (!plausible_position(here.world_from_here.translation_m)) return;
    Frame made{name, here.body, here.body_from_here, {}, {}};
    if (frame.sensor) {
        made.sensor = frame.sensor->type;
        made.lidar = frame.sensor->lidar;
    }
    draft_.add(std::move(made));
}

void SceneWalk::check_frame_of_world(const SdfPart& frame, Frames& world) {
    if (frame.kind != SdfPart::Kind::frame) return;
    if (const auto pose = world.pose_of(frame); !pose)
        draft_.warn(text_of(frame.place) + ": " + frame.name + ": " + pose.error().why +
                    "; left out");
}

std::optional<Place> SceneWalk::place_of(const Place& outer, const Expected<Pose>& pose,
                                         const FilePlace& in_file, const std::string& name,
                                         const SdfState::Entry* saved) {
    const auto where = text_of(in_file) + ": " + name + ": ";
    if (!pose) {
        draft_.leave_out(where + pose.error().why);
        return {};
    }
    const Place here = saved == nullptr ? outer * *pose : moved_to(outer, *saved);
    if (plausible_position(here.world_from_here.translation_m)) return here;
    draft_.leave_out(where + "lies at " + xyz_text(here.world_from_here.translation_m) +
                     "; everything must lie within 1e7 m of the origin");
    return {};
}

void find_meshes(const SdfPart& part, const Resources& resources, std::vector<MeshSource>& found) {
    for (const SdfSurface& surface : part.surfaces) {
        const auto* mesh = std::get_if<NamedMesh>(&surface.geometry);
        if (mesh == nullptr) continue;
        const auto file = resources.find(mesh->file.uri, mesh->file.folder);
        if (!file.empty()) found.push_back({file, mesh->view.submesh});
    }
    for (const SdfPart& inner : part.parts)
        find_meshes(inner, resources, found);
}

}  // namespace

void add_to_scene(SdfTree tree, const std::filesystem::path& file, const Resources& resources,
                  const SdfOptions& options, SceneDraft& draft) {
    MeshShelf shelf{options.most_triangles, options.mesh};
    std::vector<MeshSource> meshes;
    find_meshes(tree.root, resources, meshes);
    shelf.read_ahead(meshes);
    SceneWalk(tree, options, resources, draft, shelf).run(file);
}

}  // namespace scipd::sim
