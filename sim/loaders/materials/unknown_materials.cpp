// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/materials/unknown_materials.h"

#include <algorithm>
#include <map>
#include <set>

#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

constexpr std::size_t most_unknown_told = 100;

void note_hints(const Material& material, std::set<std::string>& hints) {
    if (material.laser_retro.value_or(0.0) > 0.0) hints.insert("laser_retro");
    if (material.appearance.transparency) hints.insert("transparency");
    if (material.appearance.metalness) hints.insert("metalness");
}

/// The materials that a scene uses and the library does not know.
std::vector<const Material*> unknown_to(const MaterialLibrary& library, const Scene& scene) {
    std::set<MaterialId> used;
    for (const Object& object : scene.objects)
        used.insert(object.material);
    std::vector<const Material*> unknown;
    for (const MaterialId id : used) {
        const Material& material = scene.materials[id];
        const bool is_named = material.name != scene.materials.front().name;
        if (is_named && library.find(material.name) == nullptr) unknown.push_back(&material);
    }
    return unknown;
}

std::string taken_as(const std::set<std::string>& hints) {
    std::string text;
    for (const std::string& hint : hints)
        text += (text.empty() ? "" : " and ") + hint;
    return text.empty() ? "like an unnamed one" : "by its " + text;
}

}  // namespace

std::vector<std::string> unknown_materials(const Scene& scene, const MaterialLibrary& library,
                                           const std::string& source) {
    std::map<std::string, std::set<std::string>> hints_of;
    for (const Material* material : unknown_to(library, scene))
        note_hints(*material, hints_of[material->name]);
    std::vector<std::string> warnings;
    for (const auto& [name, hints] : hints_of) {
        if (warnings.size() == most_unknown_told) {
            warnings.push_back(source + ": " + std::to_string(hints_of.size() - warnings.size()) +
                               " more names of materials are unknown");
            break;
        }
        warnings.push_back(source + ": no library knows the material " + quote(name, 64) +
                           ", which is taken " + taken_as(hints) +
                           "; describe it in a file that the configuration names under materials");
    }
    return warnings;
}

bool names_unknown(const Scene& scene, const MaterialLibrary& library) {
    const auto unknown = unknown_to(library, scene);
    return !std::ranges::all_of(unknown, &Material::from_script);
}

}  // namespace scipd::sim
