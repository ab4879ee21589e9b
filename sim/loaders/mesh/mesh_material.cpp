// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh/mesh_material.h"

#include <optional>
#include <span>
#include <string_view>

#include <assimp/GltfMaterial.h>

#include "sim/loaders/mesh/mesh_file.h"

namespace scipd::sim {
namespace {

std::optional<double> number_of(const aiMaterial& material, const char* key, unsigned type,
                                unsigned index) {
    float number = 0.0F;
    if (material.Get(key, type, index, number) != aiReturn_SUCCESS) return std::nullopt;
    return number;
}

std::optional<double> clear_share(const std::optional<double>& opacity) {
    return opacity ? std::optional(1.0 - *opacity) : std::nullopt;
}

/// Says nothing where metal and roughness are both 1: so a file is read that leaves them out, and
/// such a metal would be as matt as what is none. The alpha counts only where the file blends it.
Appearance as_in_gltf(const aiMaterial& material) {
    auto metalness = number_of(material, AI_MATKEY_METALLIC_FACTOR);
    const auto roughness = number_of(material, AI_MATKEY_ROUGHNESS_FACTOR);
    if (metalness == 1.0 && roughness.value_or(1.0) == 1.0) metalness.reset();
    auto transparency = number_of(material, AI_MATKEY_TRANSMISSION_FACTOR);
    aiString mode;
    const bool blends = material.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == aiReturn_SUCCESS &&
                        std::string_view{mode.C_Str()} == "BLEND";
    if (blends && transparency.value_or(0.0) == 0.0) {
        transparency = clear_share(number_of(material, AI_MATKEY_OPACITY));
    }
    return as_said(transparency, metalness, roughness);
}

Appearance as_in_mtl(const aiMaterial& material) {
    return as_said(clear_share(number_of(material, AI_MATKEY_OPACITY)),
                   number_of(material, AI_MATKEY_METALLIC_FACTOR),
                   number_of(material, AI_MATKEY_ROUGHNESS_FACTOR));
}

/// Other files say nothing that can be trusted: exporters of COLLADA do not agree on which end of
/// its transparency is clear.
Appearance as_in_file(const aiMaterial& material, const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    if (extension == ".gltf" || extension == ".glb") return as_in_gltf(material);
    return extension == ".obj" ? as_in_mtl(material) : Appearance{};
}

void keep(aiMaterial& material, const std::optional<double>& number, const char* key, unsigned type,
          unsigned index) {
    if (!number) return;
    const auto value = static_cast<float>(*number);
    material.AddProperty(&value, 1, key, type, index);
}

}  // namespace

void keep_what_matters(const aiScene& scene, const std::filesystem::path& file) {
    for (aiMaterial* material : std::span{scene.mMaterials, scene.mNumMaterials}) {
        aiString name;
        const bool is_named = material->Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS;
        const Appearance said = as_in_file(*material, file);
        material->Clear();
        if (is_named) material->AddProperty(&name, AI_MATKEY_NAME);
        keep(*material, clear_share(said.transparency), AI_MATKEY_OPACITY);
        keep(*material, said.metalness, AI_MATKEY_METALLIC_FACTOR);
        keep(*material, said.roughness, AI_MATKEY_ROUGHNESS_FACTOR);
    }
}

std::string name_of(const aiMaterial& material) {
    aiString name;
    if (material.Get(AI_MATKEY_NAME, name) != aiReturn_SUCCESS) return {};
    const std::string text = name.C_Str();
    return text == AI_DEFAULT_MATERIAL_NAME ? std::string{} : text;
}

Appearance appearance_of(const aiMaterial& material) {
    return as_in_mtl(material);
}

}  // namespace scipd::sim
