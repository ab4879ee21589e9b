// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "sim/loaders/mesh/mesh_relief.h"

namespace scipd::sim {
namespace {

using nlohmann::json;

constexpr std::size_t header_bytes = 12;
constexpr std::size_t chunk_header_bytes = 8;

[[noreturn]] void refuse_gltf() {
    throw std::runtime_error("is no glTF that can be read");
}

void keep_only(json& object, std::initializer_list<const char*> wanted) {
    if (!object.is_object()) refuse_gltf();
    json kept = json::object();
    for (const char* name : wanted) {
        if (object.contains(name)) kept[name] = std::move(object[name]);
    }
    object = std::move(kept);
}

/// Changes all elements of the array of this name, if there is one.
template <typename Change>
void for_each(json& object, const char* name, Change change) {
    if (!object.contains(name)) return;
    if (!object[name].is_array()) refuse_gltf();
    for (json& element : object[name])
        change(element);
}

/// Without textures.
void relieve_material(json& material) {
    keep_only(material, {"name", "pbrMetallicRoughness", "alphaMode"});
    if (!material.contains("pbrMetallicRoughness")) return;
    keep_only(material["pbrMetallicRoughness"],
              {"baseColorFactor", "metallicFactor", "roughnessFactor"});
}

void relieve_primitive(json& primitive, std::size_t materials) {
    keep_only(primitive, {"attributes", "indices", "material", "mode"});
    if (primitive.contains("attributes")) keep_only(primitive["attributes"], {"POSITION"});
    const json material = primitive.value("material", json{});
    if (!material.is_number_unsigned() || material.get<std::size_t>() >= materials) {
        primitive.erase("material");
    }
}

}  // namespace

std::string relieved_gltf(std::string_view text) {
    json file = json::parse(text, nullptr, false);
    if (file.is_discarded()) refuse_gltf();
    // The extension that decompresses its numbers would be dropped below.
    if (text.find("_compression\"") != text.npos) {
        throw std::runtime_error("is compressed; save it without compression");
    }
    keep_only(file, {"asset", "accessors", "buffers", "bufferViews", "materials", "meshes", "nodes",
                     "scene", "scenes"});
    for_each(file, "materials", relieve_material);
    const std::size_t materials = file.contains("materials") ? file["materials"].size() : 0;
    for_each(file, "meshes", [&](json& mesh) {
        keep_only(mesh, {"name", "primitives"});
        for_each(mesh, "primitives", [&](json& one) { relieve_primitive(one, materials); });
    });
    for_each(file, "nodes", [](json& node) {
        keep_only(node, {"name", "mesh", "children", "matrix", "translation", "rotation", "scale"});
    });
    return file.dump();
}

// The layout is little endian, as on this machine: "glTF", version, length; then chunks of length,
// kind and data.
std::string relieved_glb(std::string_view bytes) {
    const auto word_at = [&](std::size_t at) {
        std::uint32_t word = 0;
        std::memcpy(&word, bytes.data() + at, sizeof word);
        return word;
    };
    constexpr std::size_t json_at = header_bytes + chunk_header_bytes;
    if (bytes.size() < json_at || word_at(header_bytes) > bytes.size() - json_at) refuse_gltf();
    const std::size_t json_size = word_at(header_bytes);
    std::string text = relieved_gltf(bytes.substr(json_at, json_size));
    text.resize((text.size() + 3) / 4 * 4, ' ');

    const std::string_view rest = bytes.substr(json_at + json_size);
    std::string out{bytes.substr(0, 8)};
    const auto add = [&](std::size_t number) {
        const auto word = static_cast<std::uint32_t>(number);
        out.append(reinterpret_cast<const char*>(&word), sizeof word);
    };
    add(json_at + text.size() + rest.size());
    add(text.size());
    add(word_at(header_bytes + 4));
    return out + text + std::string{rest};
}

}  // namespace scipd::sim
