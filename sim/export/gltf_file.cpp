// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// By the specification of glTF 2.0 (Khronos, 2021): chapter 4 for the container, 3.6 for accessors.
#include "sim/export/gltf_file.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <nlohmann/json.hpp>

namespace scipd::sim {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");
static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::uvec3) == 12);

constexpr std::uint32_t glb_magic = 0x46546C67;   // "glTF"
constexpr std::uint32_t json_chunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t bin_chunk = 0x004E4942;   // "BIN"
constexpr int float_component = 5126;
constexpr int unsigned_component = 5125;
constexpr int array_buffer = 34962;
constexpr int element_array_buffer = 34963;

void append(std::string& bytes, std::uint32_t word) {
    bytes.append(reinterpret_cast<const char*>(&word), sizeof(word));
}

/// A chunk's length is a multiple of four.
void append_chunk(std::string& bytes, std::uint32_t kind, std::string content, char padding) {
    content.resize((content.size() + 3) / 4 * 4, padding);
    append(bytes, static_cast<std::uint32_t>(content.size()));
    append(bytes, kind);
    bytes += content;
}

Json numbers(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

class GltfWriter {
  public:
    explicit GltfWriter(const std::map<std::string, ExportedLook>& looks) : looks_(looks) {}

    std::string write(const std::vector<PlacedMesh>& meshes, const std::string& name) {
        constexpr double half = 0.70710678118654752;  // of a quarter turn about x
        Json world{{"name", name.empty() ? "world" : name},
                   {"rotation", {-half, 0.0, 0.0, half}},
                   {"children", Json::array()}};
        Json nodes = Json::array({Json{}});
        for (const PlacedMesh& placed : meshes) {
            if (placed.mesh->triangles.empty()) continue;
            world["children"].push_back(nodes.size());
            nodes.push_back(node_of(placed));
        }
        if (world["children"].empty()) world.erase("children");
        nodes[0] = std::move(world);
        Json document{{"asset", {{"version", "2.0"}, {"generator", "scipd"}}},
                      {"scene", 0},
                      {"scenes", Json::array({Json{{"nodes", Json::array({0})}}})},
                      {"nodes", std::move(nodes)}};
        // None of these lists may be empty.
        if (!meshes_.empty()) {
            document["meshes"] = std::move(meshes_);
            document["materials"] = std::move(materials_);
            document["accessors"] = std::move(accessors_);
            document["bufferViews"] = std::move(views_);
            document["buffers"] = Json::array({Json{{"byteLength", binary_.size()}}});
        }
        return container(document);
    }

  private:
    Json node_of(const PlacedMesh& placed) {
        const glm::dquat& q = placed.world_from_mesh.rotation;
        return {{"name", placed.name},
                {"mesh", mesh_of(placed)},
                {"translation", numbers(placed.world_from_mesh.translation_m)},
                {"rotation", {q.x, q.y, q.z, q.w}},
                {"scale", numbers(placed.scale)}};
    }

    std::size_t mesh_of(const PlacedMesh& placed) {
        const auto material = material_of(placed.material);
        const auto [known, is_new] =
            mesh_ids_.try_emplace({placed.mesh.get(), material}, meshes_.size());
        if (!is_new) return known->second;
        const auto [shape, is_new_shape] =
            shapes_.try_emplace(placed.mesh.get(), std::pair{std::size_t{}, std::size_t{}});
        if (is_new_shape) shape->second = {vertices_of(*placed.mesh), triangles_of(*placed.mesh)};
        const Json primitive{{"attributes", {{"POSITION", shape->second.first}}},
                             {"indices", shape->second.second},
                             {"material", material}};
        meshes_.push_back({{"primitives", Json::array({primitive})}});
        return known->second;
    }

    std::size_t material_of(const std::string& name) {
        const auto [known, is_new] = material_ids_.try_emplace(name, materials_.size());
        if (!is_new) return known->second;
        const auto found = looks_.find(name);
        const ExportedLook look = found == looks_.end() ? ExportedLook{} : found->second;
        Json material{
            {"name", name},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {look.grey, look.grey, look.grey, 1.0 - look.transparency}},
              {"metallicFactor", 0.0},
              {"roughnessFactor", 1.0}}},
            {"doubleSided", true}};
        if (look.transparency > 0.0) material["alphaMode"] = "BLEND";
        materials_.push_back(std::move(material));
        return known->second;
    }

    std::size_t vertices_of(const Mesh& mesh) {
        glm::vec3 low{std::numeric_limits<float>::max()};
        glm::vec3 high{std::numeric_limits<float>::lowest()};
        for (const glm::vec3& vertex : mesh.vertices_m) {
            low = glm::min(low, vertex);
            high = glm::max(high, vertex);
        }
        const auto id =
            add(mesh.vertices_m, mesh.vertices_m.size(), float_component, "VEC3", array_buffer);
        accessors_[id]["min"] = numbers(low);
        accessors_[id]["max"] = numbers(high);
        return id;
    }

    std::size_t triangles_of(const Mesh& mesh) {
        return add(mesh.triangles, 3 * mesh.triangles.size(), unsigned_component, "SCALAR",
                   element_array_buffer);
    }

    template <class Element>
    std::size_t add(const std::vector<Element>& list, std::size_t count, int component,
                    const char* type, int target) {
        const std::size_t bytes = list.size() * sizeof(Element);
        views_.push_back({{"buffer", 0},
                          {"byteOffset", binary_.size()},
                          {"byteLength", bytes},
                          {"target", target}});
        accessors_.push_back({{"bufferView", views_.size() - 1},
                              {"componentType", component},
                              {"count", count},
                              {"type", type}});
        binary_.append(reinterpret_cast<const char*>(list.data()), bytes);
        return accessors_.size() - 1;
    }

    [[nodiscard]] std::string container(const Json& document) const {
        std::string chunks;
        append_chunk(chunks, json_chunk,
                     document.dump(-1, ' ', false, Json::error_handler_t::replace), ' ');
        if (!binary_.empty()) append_chunk(chunks, bin_chunk, binary_, '\0');
        constexpr std::size_t head_bytes = 12;
        std::string bytes;
        append(bytes, glb_magic);
        append(bytes, 2);
        append(bytes, static_cast<std::uint32_t>(head_bytes + chunks.size()));
        return bytes + chunks;
    }

    const std::map<std::string, ExportedLook>& looks_;
    Json meshes_ = Json::array();
    Json materials_ = Json::array();
    Json accessors_ = Json::array();
    Json views_ = Json::array();
    std::string binary_;
    std::map<std::pair<const Mesh*, std::size_t>, std::size_t> mesh_ids_;
    std::map<const Mesh*, std::pair<std::size_t, std::size_t>> shapes_;
    std::map<std::string, std::size_t> material_ids_;
};

}  // namespace

std::string glb_of(const std::vector<PlacedMesh>& meshes, const std::string& name,
                   const std::map<std::string, ExportedLook>& looks) {
    return GltfWriter(looks).write(meshes, name);
}

}  // namespace scipd::sim
