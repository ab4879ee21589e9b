// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/submesh.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include "sim/loaders/load_error.h"
#include "sim/loaders/quote.h"
#include "sim/world/bounds.h"

namespace scipd::sim {
namespace {

constexpr std::size_t most_names_told = 10;

/// Walks the nodes of a file, which load_mesh_parts() has no names of any more.
class Picker {
  public:
    Picker(const aiScene& scene, const std::string& name) : scene_(scene), name_(name) {}

    /// All that lies in a node of this name belongs to it.
    void walk(const aiNode& node, const aiMatrix4x4& file_from_parent, bool inside) {
        const aiMatrix4x4 file_from_node = file_from_parent * node.mTransformation;
        const bool wanted = inside || named(node.mName);
        for (const unsigned index : std::span{node.mMeshes, node.mNumMeshes}) {
            const aiMesh& mesh = *scene_.mMeshes[index];
            if (wanted || named(mesh.mName)) append(mesh, file_from_node);
        }
        for (const aiNode* child : std::span{node.mChildren, node.mNumChildren})
            walk(*child, file_from_node, wanted);
    }

    [[nodiscard]] std::vector<MeshPart>& parts() { return parts_; }

    [[nodiscard]] std::string names() const {
        std::string text;
        std::size_t told = 0;
        for (const auto& name : names_) {
            if (told++ == most_names_told) return text + ", ...";
            text += (text.empty() ? "" : ", ") + quote(name);
        }
        return text.empty() ? "none" : text;
    }

  private:
    bool named(const aiString& name) {
        if (name.length > 0) names_.insert(name.C_Str());
        return name_ == name.C_Str();
    }

    void append(const aiMesh& from, const aiMatrix4x4& file_from_node) {
        const std::string material = scene_.mMaterials[from.mMaterialIndex]->GetName().C_Str();
        Mesh& to = part_of(material == AI_DEFAULT_MATERIAL_NAME ? "" : material);
        const auto first = static_cast<glm::uint>(to.vertices_m.size());
        for (const aiVector3D& vertex : std::span{from.mVertices, from.mNumVertices}) {
            const aiVector3D at = file_from_node * vertex;
            to.vertices_m.emplace_back(at.x, at.y, at.z);
        }
        for (const aiFace& face : std::span{from.mFaces, from.mNumFaces}) {
            if (face.mNumIndices != 3) continue;
            const std::span corner{face.mIndices, 3};
            to.triangles.emplace_back(first + corner[0], first + corner[1], first + corner[2]);
        }
    }

    Mesh& part_of(const std::string& material) {
        const auto known = std::ranges::find(parts_, material, &MeshPart::material);
        return known != parts_.end() ? known->mesh
                                     : parts_.emplace_back(MeshPart{material, {}}).mesh;
    }

    const aiScene& scene_;
    const std::string& name_;
    std::set<std::string> names_;
    std::vector<MeshPart> parts_;
};

Bounds bounds_of_all(const std::vector<MeshPart>& parts) {
    Bounds bounds;
    for (const MeshPart& part : parts) {
        for (const glm::vec3& vertex : part.mesh.vertices_m)
            bounds.include(glm::dvec3{vertex});
    }
    return bounds;
}

void place(std::vector<MeshPart>& parts, const glm::dvec3& origin, const glm::dvec3& scale) {
    for (MeshPart& part : parts) {
        for (glm::vec3& vertex : part.mesh.vertices_m)
            vertex = glm::vec3{(glm::dvec3{vertex} - origin) * scale};
    }
}

bool is_finite(const MeshPart& part) {
    return std::ranges::all_of(part.mesh.vertices_m, [](const glm::vec3& vertex) {
        return std::isfinite(vertex.x + vertex.y + vertex.z);
    });
}

}  // namespace

std::vector<MeshPart> load_submesh(const std::filesystem::path& file, const Submesh& submesh,
                                   const glm::dvec3& scale) {
    load_mesh_parts(file);  // for what it checks and says of files that are none
    Assimp::Importer importer;
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
    const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate);
    if (scene == nullptr) {
        throw LoadError({file.string() +
                         ": cannot be read as a mesh: " + printable(importer.GetErrorString())});
    }
    Picker picker{*scene, submesh.name};
    picker.walk(*scene->mRootNode, aiMatrix4x4{}, false);
    auto& parts = picker.parts();
    std::erase_if(parts, [](const MeshPart& part) { return part.mesh.triangles.empty(); });
    if (parts.empty()) {
        throw LoadError({file.string() + ": has no submesh " + quote(submesh.name) +
                         "; there are " + picker.names()});
    }
    place(parts, submesh.centred ? bounds_of_all(parts).middle_m() : glm::dvec3{0.0}, scale);
    if (!std::ranges::all_of(parts, is_finite)) {
        throw LoadError({file.string() + ": has a vertex that is not finite once scaled"});
    }
    return std::move(parts);
}

}  // namespace scipd::sim
