// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <glm/common.hpp>
#include <sdf/Element.hh>
#include <sdf/Link.hh>
#include <sdf/Material.hh>
#include <sdf/Mesh.hh>
#include <sdf/Model.hh>
#include <sdf/Visual.hh>
#include <sdf/World.hh>

#include "sim/loaders/load_error.h"
#include "sim/loaders/mesh_file.h"
#include "sim/loaders/sdf_file.h"
#include "sim/loaders/sdf_shape.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

/// A part of a mesh file, shared by every visual that shows the file at this scale.
struct SharedPart {
    std::string material;
    SharedMesh mesh;
};

Pose to_pose(const ignition::math::Pose3d& pose) {
    const auto& p = pose.Pos();
    const auto& q = pose.Rot();
    return {{p.X(), p.Y(), p.Z()}, glm::normalize(glm::dquat{q.W(), q.X(), q.Y(), q.Z()})};
}

/// Ours first; what Gazebo shows is the next best guess. Empty where the visual says neither.
std::string material_of(const sdf::Visual& visual) {
    if (const auto element = visual.Element(); element->HasElement("scipd:material")) {
        return element->GetElement("scipd:material")->Get<std::string>();
    }
    return visual.Material() == nullptr ? std::string{} : visual.Material()->ScriptName();
}

/// Walks from the root to the visuals and collects: objects, and everything that is wrong, so that
/// one run tells all.
class SceneCollector {
  public:
    explicit SceneCollector(fs::path file) : file_(std::move(file)) {}

    void add_root(const sdf::Root& root);
    void add_warning(std::string text);
    LoadedScene finish() &&;

  private:
    void add_model(const sdf::Model& model);
    void add_links(const sdf::Model& model, const Pose& top_from_model, const std::string& name);
    void add_visual(const sdf::Visual& visual, const Pose& top_from_link, const std::string& link);
    void add_mesh(const sdf::Visual& visual, Object object);
    Pose resolve(const sdf::SemanticPose& pose, const std::string& name);
    const std::vector<SharedPart>& mesh_parts(const fs::path& file, const glm::dvec3& scale);
    MaterialId material_id(const std::string& name);

    fs::path file_;
    Scene scene_;
    std::vector<std::string> faults_;
    std::vector<std::string> warnings_;
    std::set<std::string> warned_kinds_;
    std::map<std::tuple<fs::path, double, double, double>, std::vector<SharedPart>> meshes_;
};

void SceneCollector::add_root(const sdf::Root& root) {
    if (const auto* model = root.Model()) {
        scene_.name = model->Name();
        return add_model(*model);
    }
    const auto* world = root.WorldByIndex(0);
    if (world == nullptr) {
        faults_.push_back(file_.string() + ": holds no <world> and no <model>");
        return;
    }
    scene_.name = world->Name();
    if (root.WorldCount() > 1) {
        add_warning(file_.string() + ": holds several worlds; only the first, '" + scene_.name +
                    "', is used");
    }
    for (std::uint64_t i = 0; i < world->ModelCount(); ++i)
        add_model(*world->ModelByIndex(i));
}

void SceneCollector::add_warning(std::string text) {
    if (std::find(warnings_.begin(), warnings_.end(), text) == warnings_.end()) {
        warnings_.push_back(std::move(text));
    }
}

void SceneCollector::add_model(const sdf::Model& model) {
    scene_.models.push_back(
        {model.Name(), !model.Static(), resolve(model.SemanticPose(), model.Name())});
    add_links(model, Pose{}, model.Name());
}

void SceneCollector::add_links(const sdf::Model& model, const Pose& top_from_model,
                               const std::string& name) {
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
        const auto& link = *model.LinkByIndex(i);
        const auto link_name = name + "::" + link.Name();
        const auto top_from_link = top_from_model * resolve(link.SemanticPose(), link_name);
        for (std::uint64_t k = 0; k < link.VisualCount(); ++k) {
            add_visual(*link.VisualByIndex(k), top_from_link, link_name);
        }
        if (link.VisualCount() == 0 && link.CollisionCount() > 0) {
            add_warning(place_of(link.Element(), file_) + ": " + link_name +
                        " has collisions but no visual; scanners see visuals only");
        }
    }
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
        const auto& nested = *model.ModelByIndex(i);
        const auto nested_name = name + "::" + nested.Name();
        add_links(nested, top_from_model * resolve(nested.SemanticPose(), nested_name),
                  nested_name);
    }
}

void SceneCollector::add_visual(const sdf::Visual& visual, const Pose& top_from_link,
                                const std::string& link) {
    Object object;
    object.name = link + "::" + visual.Name();
    object.model = static_cast<ModelId>(scene_.models.size() - 1);
    object.model_from_object = top_from_link * resolve(visual.SemanticPose(), object.name);
    if (visual.Geom() == nullptr) return;
    if (visual.Geom()->MeshShape() != nullptr) return add_mesh(visual, std::move(object));

    const auto primitive = primitive_of(*visual.Geom());
    const auto place = place_of(visual.Element(), file_) + ": " + object.name;
    if (!primitive) {
        const auto kind = kind_of(*visual.Geom());
        if (warned_kinds_.insert(kind).second) {
            add_warning(place + ": <" + kind +
                        "> is not supported and left out, here and elsewhere");
        }
        return;
    }
    if (!has_sane_size(primitive->shape)) {
        faults_.push_back(place + ": every size must be above 0 and at most 1e7 m");
        return;
    }
    object.shape = primitive->shape;
    object.model_from_object = object.model_from_object * primitive->geometry_from_shape;
    object.material = material_id(material_of(visual));
    scene_.objects.push_back(std::move(object));
}

void SceneCollector::add_mesh(const sdf::Visual& visual, Object object) {
    const auto& mesh = *visual.Geom()->MeshShape();
    const auto place = place_of(visual.Element(), file_) + ": " + object.name;
    const auto folder = (mesh.FilePath().empty() ? file_ : fs::path{mesh.FilePath()}).parent_path();
    const auto found = find_resource(mesh.Uri(), folder);
    if (found.empty()) {
        faults_.push_back(place + ": there is no mesh '" + mesh.Uri() + "' near " +
                          folder.string());
        return;
    }
    if (!mesh.Submesh().empty()) {
        add_warning(place + ": <submesh> is not supported; the whole of '" + mesh.Uri() +
                    "' is used");
    }
    const auto material = material_of(visual);
    const glm::dvec3 scale{mesh.Scale().X(), mesh.Scale().Y(), mesh.Scale().Z()};
    try {
        for (const auto& part : mesh_parts(found, scale)) {
            object.shape = part.mesh;
            object.material = material_id(material.empty() ? part.material : material);
            scene_.objects.push_back(object);
        }
    } catch (const LoadError& error) {
        for (const auto& fault : error.faults())
            faults_.push_back(place + ": " + fault);
    }
}

Pose SceneCollector::resolve(const sdf::SemanticPose& pose, const std::string& name) {
    ignition::math::Pose3d resolved;
    for (const auto& error : pose.Resolve(resolved)) {
        faults_.push_back(file_.string() + ": " + name + ": " + error.Message());
    }
    return to_pose(resolved);
}

const std::vector<SharedPart>& SceneCollector::mesh_parts(const fs::path& file,
                                                          const glm::dvec3& scale) {
    const std::tuple key{file, scale.x, scale.y, scale.z};
    if (const auto known = meshes_.find(key); known != meshes_.end()) return known->second;
    std::vector<SharedPart> parts;
    for (auto& part : load_mesh_parts(file, scale)) {
        parts.push_back({part.material, std::make_shared<const Mesh>(std::move(part.mesh))});
    }
    return meshes_.emplace(key, std::move(parts)).first->second;
}

MaterialId SceneCollector::material_id(const std::string& name) {
    auto& all = scene_.materials;
    const auto same = [&](const Material& known) { return known.name == name; };
    auto found = name.empty() ? all.begin() : std::find_if(all.begin(), all.end(), same);
    if (found == all.end()) found = all.insert(found, {name});
    return static_cast<MaterialId>(found - all.begin());
}

LoadedScene SceneCollector::finish() && {
    if (scene_.objects.empty() && faults_.empty()) {
        // What was left out is now the reason, not a remark.
        faults_ = std::move(warnings_);
        faults_.push_back(file_.string() +
                          ": holds nothing that a scanner could see; give a model a <visual> with "
                          "a box, cylinder, sphere, plane or mesh");
    }
    if (!faults_.empty()) throw LoadError(std::move(faults_));
    // Always, not only far out: floats are finest around zero. Whole metres, so that round
    // coordinates stay round.
    scene_.anchor_m = glm::round(Scene::middle_of(scene_));
    return {std::make_shared<const Scene>(std::move(scene_)), std::move(warnings_)};
}

}  // namespace

LoadedScene load_sdf(const fs::path& given) {
    // Absolute from here on, as the library does it: a message then names every file in one way.
    const auto file = fs::absolute(given).lexically_normal();
    if (!fs::is_regular_file(file)) {
        throw LoadError({file.string() + ": no such file; name an SDF world or model"});
    }
    auto read = read_sdf_file(file);
    if (!read.faults.empty()) throw LoadError(std::move(read.faults));
    SceneCollector builder{file};
    for (auto& warning : read.warnings)
        builder.add_warning(std::move(warning));
    builder.add_root(read.root);
    return std::move(builder).finish();
}

}  // namespace scipd::sim
