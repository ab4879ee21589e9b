// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/model/model_fragment.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/mesh/mesh_parts.h"
#include "sim/loaders/sdf/sdf.h"
#include "sim/text/quote.h"
#include "sim/world/anchor.h"
#include "sim/world/script.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

void check_name(const std::string& name) {
    if (name.empty()) throw LoadError({"name: is empty; give the model one"});
    if (name.find("::") != name.npos) {
        throw LoadError({"name: " + quote(name) +
                         ": must not hold '::', which separates a model from its parts"});
    }
}

/// Replaces the name of the first model, with which all other names begin.
void rename(Scene& scene, const std::string& name) {
    const auto length = scene.models.front().name.size();
    for (Model& model : scene.models)
        model.name.replace(0, length, name);
    for (Object& object : scene.objects)
        object.name.replace(0, length, name);
    for (Frame& frame : scene.frames)
        frame.name.replace(0, length, name);
}

/// Moves the first model to this pose, and with it the parts that can move by themselves.
void move_to(Scene& scene, const Pose& world_from_model) {
    const Pose shift = world_from_model * inverse(scene.models.front().world_from_model);
    for (Model& model : scene.models) {
        model.world_from_model = shift * model.world_from_model;
        if (model.script) model.script = moved(shift, *model.script);
    }
    scene.models.front().world_from_model = world_from_model;
}

/// Makes one body of the whole model, including the parts that could move by themselves.
void make_movable(Scene& scene) {
    const Pose model_from_world = inverse(scene.models.front().world_from_model);
    const auto model_from_part = [&](ModelId part) {
        return model_from_world * scene.models[part].world_from_model;
    };
    for (Object& object : scene.objects) {
        object.model_from_object = model_from_part(object.model) * object.model_from_object;
        object.model = 0;
    }
    for (Frame& frame : scene.frames) {
        frame.model_from_frame = model_from_part(frame.model) * frame.model_from_frame;
        frame.model = 0;
    }
    scene.models.resize(1);
    scene.models.front().movable = true;
}

void make_static(Scene& scene) {
    for (Model& model : scene.models) {
        model.movable = false;
        model.script = nullptr;
    }
}

void override_static(Scene& scene, std::optional<bool> movable) {
    if (!movable) return;
    if (*movable) {
        make_movable(scene);
    } else {
        make_static(scene);
    }
}

}  // namespace

SdfOptions within_a_models_share(SdfOptions options) {
    options.most_memory_bytes /= 8;
    options.most_triangles /= 10;
    options.mesh = {.memory_bytes = options.most_memory_bytes, .triangles = options.most_triangles};
    return options;
}

LoadedScene as_model(LoadedScene loaded, const Placement& placement, const std::string& source) {
    check_name(placement.name);
    const auto& all = loaded.scene->models;
    if (all.empty()) throw LoadError({source + ": holds no model; one is wanted here"});
    const auto inside = all.front().name + "::";
    const bool one = std::all_of(all.begin() + 1, all.end(), [&](const Model& model) {
        return model.name.starts_with(inside);
    });
    if (!one) throw LoadError({source + ": holds several models; one is wanted here"});
    Scene scene = *loaded.scene;
    rename(scene, placement.name);
    override_static(scene, placement.movable);
    if (placement.world_from_model) move_to(scene, *placement.world_from_model);
    loaded.scene = std::make_shared<const Scene>(std::move(scene));
    return loaded;
}

LoadedScene load_model_text(const std::string& text, const Placement& placement,
                            const fs::path& folder, const SdfOptions& options) {
    check_name(placement.name);
    return as_model(load_sdf_text(text, placement.name, folder, options), placement,
                    placement.name);
}

LoadedScene load_mesh_model(const fs::path& file, const Placement& placement, double scale,
                            const std::string& material, const MeshLimits& limits) {
    check_name(placement.name);
    if (!(scale > 0.0 && scale <= 1e7)) {
        throw LoadError({"scale: must be above 0 and at most 1e7"});
    }
    Scene scene;
    scene.name = placement.name;
    scene.models.push_back({placement.name, placement.movable.value_or(true),
                            placement.world_from_model.value_or(Pose{})});
    for (MeshPart& part : load_mesh_parts(file, glm::dvec3{scale}, MeshAxes::z_up, limits)) {
        const Material own{.name = part.material, .appearance = part.appearance};
        const auto id = id_of(material.empty() ? own : Material{material}, scene.materials);
        scene.objects.push_back({placement.name + "::" + file.stem().string(), 0, Pose{},
                                 std::make_shared<const Mesh>(std::move(part.mesh)), id});
    }
    scene.anchor_m = anchor_of(scene);
    return {std::make_shared<const Scene>(std::move(scene)), {}};
}

}  // namespace scipd::sim
