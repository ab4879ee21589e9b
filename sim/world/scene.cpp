// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/scene.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace scipd::sim {
namespace {

bool is_or_lies_in(std::string_view name, std::string_view outer) {
    if (!name.starts_with(outer)) return false;
    name.remove_prefix(outer.size());
    return name.empty() || name.starts_with("::");
}

}  // namespace

MaterialId id_of(Material material, std::vector<Material>& materials) {
    if (material.name.empty()) material.name = materials.front().name;
    auto found = std::ranges::find(materials, material);
    if (found == materials.end()) found = materials.insert(found, std::move(material));
    return static_cast<MaterialId>(found - materials.begin());
}

std::optional<ModelId> find_model(const Scene& scene, std::string_view name) {
    const auto found = std::ranges::find(scene.models, name, &Model::name);
    if (found == scene.models.end()) return std::nullopt;
    return static_cast<ModelId>(found - scene.models.begin());
}

SharedScene with_models(const Scene& scene, const Scene& added) {
    auto both = std::make_shared<Scene>(scene);
    if (scene.objects.empty()) both->anchor_m = added.anchor_m;
    const auto first = static_cast<ModelId>(scene.models.size());
    for (const Model& model : added.models) {
        assert(!find_model(scene, model.name));
        both->models.push_back(model);
    }
    for (Object object : added.objects) {
        object.model += first;
        object.material = id_of(added.materials[object.material], both->materials);
        both->objects.push_back(std::move(object));
    }
    for (Frame frame : added.frames) {
        frame.model += first;
        both->frames.push_back(std::move(frame));
    }
    return both;
}

SharedScene without_shapes(const Scene& scene) {
    const auto nothing = std::make_shared<const Mesh>();
    auto names = std::make_shared<Scene>();
    names->name = scene.name;
    names->models = scene.models;
    names->materials = scene.materials;
    names->anchor_m = scene.anchor_m;
    names->objects.reserve(scene.objects.size());
    for (const Object& object : scene.objects)
        names->objects.push_back(
            {object.name, object.model, object.model_from_object, nothing, object.material});
    return names;
}

SharedScene without_model(const Scene& scene, std::string_view name) {
    if (!find_model(scene, name)) return nullptr;
    auto rest = std::make_shared<Scene>();
    rest->name = scene.name;
    rest->materials = scene.materials;
    rest->anchor_m = scene.anchor_m;
    std::vector<std::optional<ModelId>> new_id;
    for (const Model& model : scene.models) {
        const bool goes = is_or_lies_in(model.name, name);
        new_id.push_back(goes ? std::nullopt : std::optional(ModelId(rest->models.size())));
        if (!goes) rest->models.push_back(model);
    }
    for (const Object& object : scene.objects) {
        if (!new_id[object.model]) continue;
        rest->objects.push_back(object);
        rest->objects.back().model = *new_id[object.model];
    }
    for (const Frame& frame : scene.frames) {
        if (!new_id[frame.model]) continue;
        rest->frames.push_back(frame);
        rest->frames.back().model = *new_id[frame.model];
    }
    drop_unused_names(*rest);
    return rest;
}

void drop_unused_names(Scene& scene) {
    constexpr MaterialId gone = std::numeric_limits<MaterialId>::max();
    std::vector<MaterialId> new_id(scene.materials.size(), gone);
    new_id.front() = 0;
    for (const Object& object : scene.objects)
        new_id[object.material] = 0;
    std::vector<Material> kept;
    for (MaterialId id = 0; id < new_id.size(); ++id) {
        Material& material = scene.materials[id];
        if (new_id[id] == gone && material == Material{material.name}) continue;
        new_id[id] = static_cast<MaterialId>(kept.size());
        kept.push_back(std::move(material));
    }
    scene.materials = std::move(kept);
    for (Object& object : scene.objects)
        object.material = new_id[object.material];
}

}  // namespace scipd::sim
