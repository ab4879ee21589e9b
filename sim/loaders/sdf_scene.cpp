// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include <glm/common.hpp>
#include <sdf/Element.hh>
#include <sdf/Link.hh>
#include <sdf/Mesh.hh>
#include <sdf/Model.hh>
#include <sdf/World.hh>

#include "sim/loaders/load_error.h"
#include "sim/loaders/mesh_shelf.h"
#include "sim/loaders/name.h"
#include "sim/loaders/sdf_document.h"
#include "sim/loaders/sdf_place.h"
#include "sim/loaders/sdf_shape.h"
#include "sim/loaders/sdf_surface.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

std::string text_of(const glm::dvec3& xyz_m) {
    std::array<char, 100> text{};
    std::snprintf(text.data(), text.size(), "%g %g %g", xyz_m.x, xyz_m.y, xyz_m.z);
    return text.data();
}

bool says_not_static(const sdf::Model& model) {
    return !model.Static() && model.Element()->HasElement("static");
}

/// Walks from the root to the surfaces and collects: objects, and everything that is wrong, so that
/// one run tells all.
class SceneCollector {
  public:
    SceneCollector(SdfFile read, fs::path file, const Resources& resources, SdfOptions options)
        : read_(std::move(read)),
          file_(std::move(file)),
          resources_(resources),
          options_(std::move(options)),
          shelf_(options_.most_triangles, options_.mesh) {
        anything_left_out_ = !read_.warnings.empty();
        for (auto& warning : read_.warnings)
            add_warning(std::move(warning));
    }

    void add_root();
    LoadedScene finish() &&;

  private:
    void add_model(const sdf::Model& model);
    /// Short enough.
    std::string name_of(const sdf::Model& model);
    void add_parts(const sdf::Model& model, const Place& place, const std::string& name);
    void add_nested(const sdf::Model& model, const Place& outer, const std::string& outer_name);
    void add_link(const sdf::Link& link, const Place& place, const std::string& name);
    void add_surface(const SdfSurface& surface, const Place& link, const std::string& link_name);
    void add_mesh(const SdfSurface& surface, const sdf::Mesh& mesh, Object object);
    void warn_of_unseen(const sdf::Link& link, const std::string& name);
    std::optional<Place> place_of(const Place& outer, const sdf::SemanticPose& pose,
                                  const sdf::ElementPtr& element, const std::string& name);
    void leave_out(const std::string& why);
    MaterialId material_id(const Material& material);
    void add_warning(std::string text);
    void show_names();

    SdfFile read_;
    fs::path file_;
    const Resources& resources_;
    SdfOptions options_;
    Scene scene_;
    std::vector<std::string> faults_;
    std::vector<std::string> warnings_;
    std::set<std::string> warned_kinds_;
    bool anything_left_out_ = false;
    MeshShelf shelf_;
};

void SceneCollector::add_root() {
    if (const auto* model = read_.root.Model()) {
        scene_.name = model->Name();
        return add_model(*model);
    }
    const auto* world = read_.root.WorldByIndex(0);
    if (world == nullptr) {
        faults_.push_back(file_.string() + ": holds no <world> and no <model>");
        return;
    }
    scene_.name = world->Name();
    if (read_.root.WorldCount() > 1) {
        add_warning(file_.string() + ": holds several worlds; only the first, '" + scene_.name +
                    "', is used");
    }
    for (std::uint64_t i = 0; i < world->ModelCount(); ++i)
        add_model(*world->ModelByIndex(i));
}

void SceneCollector::add_warning(std::string text) {
    if (std::ranges::find(warnings_, text) == warnings_.end()) {
        warnings_.push_back(std::move(text));
    }
}

void SceneCollector::add_model(const sdf::Model& model) {
    const std::string name = name_of(model);
    const auto place = place_of({}, model.SemanticPose(), model.Element(), name);
    if (!place) return;
    const Pose& world_from_model = place->world_from_here;
    scene_.models.push_back({name, !model.Static(), world_from_model});
    add_parts(model, {ModelId(scene_.models.size() - 1), {}, world_from_model}, name);
}

std::string SceneCollector::name_of(const sdf::Model& model) {
    std::string name = short_name(model.Name());
    if (name != model.Name()) {
        add_warning(read_.place_of(model.Element(), file_) + ": the name has more than " +
                    std::to_string(longest_name) + " bytes; the model is called " + name);
    }
    return name;
}

void SceneCollector::add_parts(const sdf::Model& model, const Place& place,
                               const std::string& name) {
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
        const auto& link = *model.LinkByIndex(i);
        const auto link_name = name + "::" + link.Name();
        const auto here = place_of(place, link.SemanticPose(), link.Element(), link_name);
        if (here) add_link(link, *here, link_name);
    }
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i)
        add_nested(*model.ModelByIndex(i), place, name);
}

void SceneCollector::add_nested(const sdf::Model& model, const Place& outer,
                                const std::string& outer_name) {
    const auto name = outer_name + "::" + name_of(model);
    auto place = place_of(outer, model.SemanticPose(), model.Element(), name);
    if (!place) return;
    if (!scene_.models[outer.body].movable && says_not_static(model)) {
        scene_.models.push_back({name, true, place->world_from_here});
        place = {ModelId(scene_.models.size() - 1), {}, place->world_from_here};
    }
    add_parts(model, *place, name);
}

void SceneCollector::add_link(const sdf::Link& link, const Place& place, const std::string& name) {
    for (const SdfSurface& surface : surfaces_of(link, options_.geometry))
        add_surface(surface, place, name);
    warn_of_unseen(link, name);
}

void SceneCollector::warn_of_unseen(const sdf::Link& link, const std::string& name) {
    const bool visual = options_.geometry == SdfGeometry::visual;
    const auto seen = visual ? link.VisualCount() : link.CollisionCount();
    const auto unseen = visual ? link.CollisionCount() : link.VisualCount();
    if (seen > 0 || unseen == 0) return;
    add_warning(read_.place_of(link.Element(), file_) + ": " + name +
                (visual ? " has collisions but no visual; scanners see visuals only"
                        : " has visuals but no collision; scanners see collisions only"));
}

void SceneCollector::add_surface(const SdfSurface& surface, const Place& link,
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
        return leave_out(place + "laser_retro must be finite");
    }
    try {
        if (const auto* mesh = surface.geometry->MeshShape()) {
            return add_mesh(surface, *mesh, std::move(object));
        }
        const auto primitive = primitive_of(*surface.geometry);
        if (!primitive) {
            const auto kind = kind_of(*surface.geometry);
            anything_left_out_ = true;
            if (!warned_kinds_.insert(kind).second) return;
            return add_warning(place + '<' + kind +
                               "> is not supported and left out, here and elsewhere");
        }
        object.shape = primitive->shape;
        shelf_.count(object.shape);
        object.model_from_object = object.model_from_object * primitive->geometry_from_shape;
        object.material = material_id({surface.material, surface.laser_retro});
        scene_.objects.push_back(std::move(object));
    } catch (const LoadError& error) {
        for (const auto& fault : error.faults())
            leave_out(place + fault);
    }
}

void SceneCollector::add_mesh(const SdfSurface& surface, const sdf::Mesh& mesh, Object object) {
    const auto file = read_.file_of(mesh.Element(), file_);
    // A text is called by a name, and lies in no folder.
    const auto folder = file.is_absolute() ? file.parent_path() : resources_.folder();
    const auto found = resources_.find(mesh.Uri(), folder);
    if (found.empty()) throw LoadError({resources_.not_found(mesh.Uri(), folder)});
    for (const auto& part : shelf_.parts_of(found, mesh)) {
        object.shape = part.mesh;
        object.material = material_id(
            {surface.material.empty() ? part.material : surface.material, surface.laser_retro});
        scene_.objects.push_back(object);
    }
}

/// What lies in `outer` at this pose; nothing where it cannot lie there.
std::optional<Place> SceneCollector::place_of(const Place& outer, const sdf::SemanticPose& pose,
                                              const sdf::ElementPtr& element,
                                              const std::string& name) {
    const auto where = read_.place_of(element, file_) + ": " + name + ": ";
    ignition::math::Pose3d resolved;
    if (const auto errors = pose.Resolve(resolved); !errors.empty()) {
        leave_out(where + errors.front().Message());
        return {};
    }
    const Place here = outer * to_pose(resolved);
    const auto& [at_m, rotation] = here.world_from_here;
    if (plausible_position(at_m) && std::isfinite(glm::length(rotation))) return here;
    leave_out(where + "lies at " + text_of(at_m) +
              "; everything must lie within 1e7 m of the origin");
    return {};
}

MaterialId SceneCollector::material_id(const Material& material) {
    auto& all = scene_.materials;
    const Material wanted{material.name.empty() ? all.front().name : material.name,
                          material.laser_retro};
    auto found = std::ranges::find(all, wanted);
    if (found == all.end()) found = all.insert(found, wanted);
    return static_cast<MaterialId>(found - all.begin());
}

void SceneCollector::leave_out(const std::string& why) {
    anything_left_out_ = true;
    if (options_.strict) {
        faults_.push_back(why);
    } else {
        add_warning(why + (why.ends_with('?') ? " It is left out" : "; left out"));
    }
}

void SceneCollector::show_names() {
    for (Model& model : scene_.models)
        model.name = shown(model.name);
    for (Object& object : scene_.objects)
        object.name = shown(object.name);
    std::ranges::transform(warnings_, warnings_.begin(), shown);
    std::ranges::transform(faults_, faults_.begin(), shown);
}

LoadedScene SceneCollector::finish() && {
    if (scene_.objects.empty() && faults_.empty()) {
        const std::string kind =
            options_.geometry == SdfGeometry::visual ? "<visual>" : "<collision>";
        add_warning(file_.string() + ": holds nothing that a scanner could see; give a model a " +
                    kind + " with a box, cylinder, sphere, plane or mesh");
        // What was left out is then the reason, not a remark.
        if (anything_left_out_) faults_ = warnings_;
    }
    show_names();
    if (!faults_.empty()) throw LoadError(std::move(faults_));
    // Always, not only far out: floats are finest around zero. Whole metres, so that round
    // coordinates stay round.
    scene_.anchor_m = glm::round(Scene::middle_of(scene_));
    return {std::make_shared<const Scene>(std::move(scene_)), std::move(warnings_)};
}

}  // namespace

LoadedScene scene_of(SdfFile read, const fs::path& source, const Resources& resources,
                     const SdfOptions& options) {
    SceneCollector collector{std::move(read), source, resources, options};
    collector.add_root();
    return std::move(collector).finish();
}

}  // namespace scipd::sim
