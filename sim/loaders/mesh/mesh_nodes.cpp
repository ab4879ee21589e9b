// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh/mesh_nodes.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include <assimp/GltfMaterial.h>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "sim/loaders/mesh/mesh_file.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

constexpr std::size_t most_names_told = 10;

glm::dmat4 matrix_of(const aiMatrix4x4& m) {
    return {m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2,
            m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4};
}

std::span<aiNode* const> children_of(const aiNode& node) {
    return {node.mChildren, node.mNumChildren};
}

std::span<const unsigned> meshes_of(const aiNode& node) {
    return {node.mMeshes, node.mNumMeshes};
}

void append(const aiMesh& from, const glm::dmat4& here_from_node, Mesh& to) {
    const auto first = static_cast<glm::uint>(to.vertices_m.size());
    for (const aiVector3D& v : std::span{from.mVertices, from.mNumVertices})
        to.vertices_m.emplace_back(here_from_node * glm::dvec4{v.x, v.y, v.z, 1.0});
    // A mirror turns the faces round.
    const bool is_mirrored = glm::determinant(glm::dmat3{here_from_node}) < 0.0;
    for (const aiFace& face : std::span{from.mFaces, from.mNumFaces}) {
        if (face.mNumIndices != 3) continue;
        const std::span corner{face.mIndices, 3};
        const unsigned second = corner[is_mirrored ? 2 : 1];
        const unsigned third = corner[is_mirrored ? 1 : 2];
        to.triangles.emplace_back(first + corner[0], first + second, first + third);
    }
}

/// Collects meshes of a scene as parts of one material each.
class PartsByMaterial {
  public:
    explicit PartsByMaterial(const aiScene& scene) : scene_(scene) {}

    void add(const aiMesh& mesh, const glm::dmat4& here_from_node) {
        append(mesh, here_from_node, parts_[part_of(mesh.mMaterialIndex)].mesh);
    }

    /// Those that hold a triangle.
    std::vector<MeshPart> take() && {
        std::erase_if(parts_, [](const MeshPart& part) { return part.mesh.triangles.empty(); });
        return std::move(parts_);
    }

  private:
    std::size_t part_of(unsigned material) {
        const auto known = part_of_material_.find(material);
        if (known != part_of_material_.end()) return known->second;
        return part_of_material_[material] = equal_part(material);
    }

    /// Materials may be alike but for what no range depends on.
    std::size_t equal_part(unsigned index) {
        MeshPart wanted;
        if (index < scene_.mNumMaterials) {
            const aiMaterial& material = *scene_.mMaterials[index];
            wanted.material = name_of(material);
            wanted.appearance = appearance_of(material);
        }
        const auto known = std::ranges::find_if(parts_, [&](const MeshPart& part) {
            return part.material == wanted.material && part.appearance == wanted.appearance;
        });
        const auto part = static_cast<std::size_t>(known - parts_.begin());
        if (known == parts_.end()) parts_.push_back(std::move(wanted));
        return part;
    }

    const aiScene& scene_;
    std::vector<MeshPart> parts_;
    std::map<unsigned, std::size_t> part_of_material_;
};

/// What is to be collected. The meaning that a name has in Gazebo comes first.
enum class Named {
    /// A node without those of its inner nodes that have names of their own. gz-common 5 and Gazebo
    /// Classic name submeshes so (ColladaLoader.cc, AssimpLoader.cc).
    node,
    mesh,
    node_with_all,
    everything,  ///< whatever its name
};

/// Whether Assimp made up the name.
bool is_made_up(const aiString& name) {
    return std::string_view{name.C_Str()}.starts_with("$ColladaAutoName$");
}

/// Walks the nodes of a file and collects the meshes that a name means.
class Picker {
  public:
    Picker(const aiScene& scene, std::string_view name, Named named)
        : scene_(scene), name_(name), named_(named), parts_(scene) {}

    std::vector<MeshPart> pick(const glm::dmat4& here_from_file) && {
        walk(*scene_.mRootNode, here_from_file, named_ == Named::everything);
        return std::move(parts_).take();
    }

  private:
    void walk(const aiNode& node, const glm::dmat4& here_from_parent, bool inside) {
        const glm::dmat4 here_from_node = here_from_parent * matrix_of(node.mTransformation);
        if (name_ == node.mName.C_Str()) {
            inside = true;
        } else if (named_ == Named::node && !is_made_up(node.mName)) {
            inside = false;
        }
        for (const unsigned index : meshes_of(node)) {
            const aiMesh& mesh = *scene_.mMeshes[index];
            const bool is_wanted = named_ == Named::mesh ? name_ == mesh.mName.C_Str() : inside;
            if (is_wanted) parts_.add(mesh, here_from_node);
        }
        for (const aiNode* child : children_of(node))
            walk(*child, here_from_node, inside);
    }

    const aiScene& scene_;
    const std::string_view name_;
    const Named named_;
    PartsByMaterial parts_;
};

void collect_names(const aiNode& node, std::set<std::string>& names) {
    names.insert(node.mName.C_Str());
    for (const aiNode* child : children_of(node))
        collect_names(*child, names);
}

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

std::vector<MeshPart> parts_of(const aiScene& scene, const glm::dmat4& here_from_file) {
    return Picker{scene, {}, Named::everything}.pick(here_from_file);
}

std::vector<MeshPart> submesh_of(const aiScene& scene, const std::string& name) {
    for (const Named named : {Named::node, Named::mesh, Named::node_with_all}) {
        auto parts = Picker{scene, name, named}.pick(glm::dmat4{1.0});
        if (!parts.empty()) return parts;
    }
    return {};
}

std::string names_in(const aiScene& scene) {
    std::set<std::string> names;
    collect_names(*scene.mRootNode, names);
    for (const aiMesh* mesh : std::span{scene.mMeshes, scene.mNumMeshes})
        names.insert(mesh->mName.C_Str());
    std::erase_if(names,
                  [](const auto& name) { return name.empty() || is_made_up(aiString{name}); });
    std::string text;
    std::size_t told = 0;
    for (const auto& name : names) {
        if (told++ == most_names_told) return text + ", ...";
        text += (text.empty() ? "" : ", ") + quote(name, whole_path);
    }
    return text.empty() ? "none" : text;
}

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
