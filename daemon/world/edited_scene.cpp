// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/edited_scene.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <variant>

#include "daemon/world/base64.h"
#include "daemon/world/outside_world.h"
#include "sim/loaders/file/allowed_folder.h"
#include "sim/loaders/file/crowding.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/resources/resources.h"
#include "sim/text/likely_unit.h"
#include "sim/world/bounds.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

/// A mesh that came as bytes, as a file for as long as it is read: nothing else lies in its folder,
/// so that it can name nothing else.
class InlineMesh {
  public:
    /// `data` is base64; `format` is how the file's name shall end. Throws LoadError.
    InlineMesh(const std::string& data, const std::string& format);
    InlineMesh(const InlineMesh&) = delete;
    InlineMesh& operator=(const InlineMesh&) = delete;
    ~InlineMesh();

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

  private:
    std::filesystem::path folder_;
    std::filesystem::path file_;
};

/// One that only this user can open.
fs::path new_folder() {
    std::error_code error;
    std::string name = (fs::temp_directory_path(error) / "scipd-mesh-XXXXXX").string();
    if (error || ::mkdtemp(name.data()) == nullptr)
        throw sim::LoadError({"there is no folder to read the mesh in; TMPDIR can name one"});
    return fs::canonical(name);
}

InlineMesh::InlineMesh(const std::string& data, const std::string& format) {
    const auto bytes = base64_decoded(data);
    if (!bytes) throw sim::LoadError({"mesh_data must be base64"});
    folder_ = new_folder();
    file_ = folder_ / ("mesh." + format);
    std::ofstream file(file_, std::ios::binary);
    file.write(bytes->data(), static_cast<std::streamsize>(bytes->size()));
}

InlineMesh::~InlineMesh() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

using Result = EditOutcome::Result;

tl::unexpected<EditOutcome> refuse(Result result, const std::string& why) {
    return tl::unexpected(EditOutcome{result, {why}});
}

/// What the API may name, and what is there for all worlds by the will of who started this.
sim::Folders to_read(const PresentScene& present) {
    sim::Folders folders = present.allow;
    for (const auto& more : {sim::resource_folders(), present.options.sdf.model_folders})
        folders.insert(folders.end(), more.begin(), more.end());
    return folders;
}

tl::unexpected<EditOutcome> forbid(const std::filesystem::path& file,
                                   const std::vector<std::filesystem::path>& allow) {
    std::string folders;
    for (const auto& folder : allow)
        folders += (folders.empty() ? "" : ", ") + folder.string();
    return refuse(Result::forbidden,
                  file.string() + " is not in a folder that `allow` in the configuration names; " +
                      (folders.empty() ? "it names none" : "it names " + folders));
}

EditedOrNot edited(const LoadWorld& edit, const PresentScene& present) {
    const auto file = (sim::folder_of_scene(present.file) / edit.file).lexically_normal();
    if (!sim::lies_in_one_of(present.allow, file)) return forbid(file, present.allow);
    auto [scene, warnings] = sim::load_scene(file, present.options);
    return EditedScene{file, scene, scene, std::move(warnings), {}, {}};
}

/// The file that it names, if it names one.
std::filesystem::path file_of(const AddModel& edit, const PresentScene& present) {
    return sim::folder_of_scene(present.file) / (edit.file.empty() ? edit.mesh : edit.file);
}

sim::LoadedScene load_model(const AddModel& edit, const PresentScene& present) {
    return sim::load_model({.placement = edit.placement,
                            .text = edit.sdf,
                            .folder = sim::folder_of_scene(present.file),
                            .file = edit.file.empty() ? edit.file : file_of(edit, present),
                            .mesh = edit.mesh.empty() ? edit.mesh : file_of(edit, present),
                            .scale = edit.scale,
                            .material = edit.material},
                           present.options);
}

std::size_t triangles_of(const sim::Scene& scene) {
    std::set<sim::SharedMesh> meshes;  // each of which many objects may show
    for (const sim::Object& object : scene.objects) {
        const auto* mesh = std::get_if<sim::SharedMesh>(&object.shape);
        if (mesh != nullptr) meshes.insert(*mesh);
    }
    std::size_t triangles = 0;
    for (const sim::SharedMesh& mesh : meshes)
        triangles += mesh->triangles.size();
    return triangles;
}

/// Many small models may together be too large.
void check_triangles(const sim::Scene& scene, std::size_t most) {
    if (triangles_of(scene) <= most) return;
    throw sim::LoadError({"with this one the world has more than " + std::to_string(most) +
                          " triangles; world_triangles under limits in the configuration allows "
                          "more"});
}

tl::unexpected<EditOutcome> too_much(Limit limit, const PresentScene& present) {
    EditOutcome outcome{Result::too_much, {beyond(limit, present.limits[limit])}};
    outcome.limit = limit;
    return tl::unexpected(std::move(outcome));
}

bool within(const LimitValues& limits, Limit limit, std::size_t count) {
    return count <= static_cast<std::size_t>(limits[limit]);
}

std::size_t triangles_of(const AddedTriangles& added) {
    std::size_t triangles = 0;
    for (const auto& [name, count] : added)
        triangles += count;
    return triangles;
}

/// Models that are not wanted yet may lie far outside on purpose, so that this is no warning.
std::optional<std::string> note_of_place(const AddModel& edit, const sim::Scene& scene) {
    const auto& pose = edit.placement.world_from_model;
    if (!pose) return std::nullopt;
    const glm::dvec3& at_m = pose->translation_m;
    // Mostly that is enough to know, and it takes no look at the whole world.
    if (!sim::could_be_millimetres(std::array{at_m.x, at_m.y, at_m.z})) return std::nullopt;
    return millimetres_beside(sim::extent_of(scene), at_m);
}

EditedOrNot with_model(const AddModel& edit, const PresentScene& present) {
    sim::SharedScene scene = present.scene;
    const std::string& name = edit.placement.name;
    if (sim::find_model(*scene, name)) {
        if (!edit.replace) {
            return refuse(Result::taken, "there is a model \"" + name +
                                             "\"; with \"replace\": true this takes its place");
        }
        scene = sim::without_model(*scene, name);
    }
    const auto file = file_of(edit, present);
    if (edit.sdf.empty() && !sim::lies_in_one_of(present.allow, file))
        return forbid(file, present.allow);
    AddedTriangles all = present.added;
    std::size_t& triangles = all[name];
    if (!within(present.limits, Limit::added_models, all.size()))
        return too_much(Limit::added_models, present);
    if (present.options.sdf.strict && !edit.warnings.empty()) throw sim::LoadError(edit.warnings);
    auto [added, warnings] = load_model(edit, present);
    std::ranges::copy(edit.warnings, std::back_inserter(warnings));
    std::vector<std::string> notes;
    if (const auto note = note_of_place(edit, *present.scene))
        notes.push_back("pose.xyz: " + *note);
    triangles = triangles_of(*added);
    if (!within(present.limits, Limit::added_triangles, triangles_of(all)))
        return too_much(Limit::added_triangles, present);
    scene = sim::with_models(*scene, *added);
    check_triangles(*scene, present.options.sdf.most_triangles);
    sim::check_overlap(*scene, *added, edit.sdf.empty() ? file.string() : name,
                       present.options.most_overlap);
    return EditedScene{present.file,        std::move(scene), added,
                       std::move(warnings), std::move(notes), std::move(all)};
}

/// Whoever sent bytes knows of no file.
std::vector<std::string> told_of_data(std::vector<std::string> lines,
                                      const std::filesystem::path& file) {
    for (std::string& line : lines) {
        for (auto at = line.find(file.string()); at != line.npos; at = line.find(file.string()))
            line.replace(at, file.string().size(), "mesh_data");
    }
    return lines;
}

EditedOrNot edited(const AddModel& edit, const PresentScene& present) {
    if (edit.mesh_data.empty()) return with_model(edit, present);
    const InlineMesh mesh(edit.mesh_data, edit.mesh_format);
    AddModel of_file = edit;
    of_file.mesh = mesh.file();
    PresentScene beside = present;
    beside.allow.push_back(mesh.folder());
    beside.options.limits.folders->push_back(mesh.folder());
    try {
        EditedOrNot now = with_model(of_file, beside);
        if (now) now->warnings = told_of_data(std::move(now->warnings), mesh.file());
        return now;
    } catch (const sim::LoadError& error) {
        throw sim::LoadError(told_of_data(error.faults(), mesh.file()));
    }
}

std::vector<sim::Object*> objects_of(sim::Scene& scene, const std::string& model) {
    std::vector<sim::Object*> own;
    for (sim::Object& object : scene.objects) {
        const std::string& name = scene.models[object.model].name;
        if (name == model || name.starts_with(model + "::")) own.push_back(&object);
    }
    return own;
}

/// What the scene itself says of a material of this name counts, such as its laser_retro.
sim::MaterialId material_called(const std::string& name, sim::Scene& scene) {
    const auto own = std::ranges::find(scene.materials, name, &sim::Material::name);
    if (own == scene.materials.end()) return sim::id_of({name}, scene.materials);
    return static_cast<sim::MaterialId>(own - scene.materials.begin());
}

std::vector<std::string> warnings_about(const std::vector<sim::Object*>& objects,
                                        const sim::Scene& scene, const std::string& model,
                                        const sim::SceneOptions& options) {
    auto alone = std::make_shared<sim::Scene>();
    alone->materials = scene.materials;
    for (const sim::Object* object : objects)
        alone->objects.push_back(*object);
    sim::LoadedScene told{alone, {}};
    sim::check_materials(told, model, options);
    return told.warnings;
}

EditedOrNot edited(const SetMaterial& edit, const PresentScene& present) {
    if (!sim::find_model(*present.scene, edit.model))
        return refuse(Result::unknown, "there is no model \"" + edit.model + "\"");
    auto scene = std::make_shared<sim::Scene>(*present.scene);
    const std::vector<sim::Object*> objects = objects_of(*scene, edit.model);
    const auto& wanted = edit.materials;
    if (wanted.size() != 1 && wanted.size() != objects.size()) {
        const std::size_t count = objects.size();
        return refuse(Result::faulty, "the model \"" + edit.model + "\" has " +
                                          std::to_string(count) +
                                          (count == 1 ? " object" : " objects") + ", not " +
                                          std::to_string(wanted.size()));
    }
    for (std::size_t i = 0; i < objects.size(); ++i)
        objects[i]->material = material_called(wanted[wanted.size() == 1 ? 0 : i], *scene);
    sim::drop_unused_names(*scene);
    auto warnings = warnings_about(objects, *scene, edit.model, present.options);
    return EditedScene{
        present.file, std::move(scene), std::make_shared<const sim::Scene>(), std::move(warnings),
        {},           present.added};
}

EditedOrNot edited(const RemoveModel& edit, const PresentScene& present) {
    sim::SharedScene rest = sim::without_model(*present.scene, edit.name);
    if (!rest) return refuse(Result::unknown, "there is no model \"" + edit.name + "\"");
    AddedTriangles others = present.added;
    others.erase(edit.name);
    return EditedScene{present.file, std::move(rest),  std::make_shared<const sim::Scene>(), {},
                       {},           std::move(others)};
}

}  // namespace

EditedOrNot edited(const SceneEdit& edit, PresentScene present) {
    present.options.limits.folders = to_read(present);
    return std::visit([&](const auto& wanted) { return edited(wanted, present); }, edit);
}

}  // namespace scipd::daemon
