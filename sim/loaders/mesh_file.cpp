// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include "sim/loaders/load_error.h"
#include "sim/loaders/quote.h"

namespace scipd::sim {
namespace {

/// Positions and faces are all that a range needs; without the rest more vertices are identical and
/// can be shared.
constexpr int unwanted = aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                         aiComponent_COLORS | aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS |
                         aiComponent_ANIMATIONS | aiComponent_TEXTURES | aiComponent_LIGHTS |
                         aiComponent_CAMERAS;

constexpr unsigned int steps = aiProcess_Triangulate | aiProcess_RemoveComponent |
                               aiProcess_PreTransformVertices | aiProcess_SortByPType |
                               aiProcess_ValidateDataStructure;

std::span<aiMesh* const> meshes_of(const aiScene& scene) {
    return {scene.mMeshes, scene.mNumMeshes};
}

bool is_finite(const aiMesh* mesh) {
    return std::ranges::all_of(std::span{mesh->mVertices, mesh->mNumVertices},
                               [](const aiVector3D& v) { return std::isfinite(v.x + v.y + v.z); });
}

const aiScene& read(Assimp::Importer& importer, const std::filesystem::path& file) {
    if (!std::filesystem::is_regular_file(file)) {
        throw LoadError({file.string() + ": no such file; a mesh is wanted here"});
    }
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, unwanted);
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    // Otherwise a COLLADA file that says Z_UP would be turned to y up: robots live in z up.
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
    const aiScene* scene = importer.ReadFile(file.string(), steps);
    if (scene != nullptr && !std::ranges::all_of(meshes_of(*scene), is_finite)) {
        throw LoadError({file.string() + ": has a vertex that is not finite"});
    }
    // Last, since it takes a NaN for identical to any vertex and would hide it.
    if (scene != nullptr) scene = importer.ApplyPostProcessing(aiProcess_JoinIdenticalVertices);
    if (scene == nullptr) {
        throw LoadError({file.string() +
                         ": cannot be read as a mesh: " + printable(importer.GetErrorString())});
    }
    return *scene;
}

/// Appends; false where a vertex does not stay finite.
bool append(const aiMesh& from, const glm::dvec3& scale, Mesh& to) {
    const auto first = static_cast<glm::uint>(to.vertices_m.size());
    for (const aiVector3D& vertex : std::span{from.mVertices, from.mNumVertices}) {
        const glm::vec3 scaled_m{glm::dvec3{vertex.x, vertex.y, vertex.z} * scale};
        if (!std::isfinite(scaled_m.x + scaled_m.y + scaled_m.z)) return false;
        to.vertices_m.push_back(scaled_m);
    }
    for (const aiFace& face : std::span{from.mFaces, from.mNumFaces}) {
        if (face.mNumIndices != 3) continue;
        const std::span corner{face.mIndices, 3};
        to.triangles.emplace_back(first + corner[0], first + corner[1], first + corner[2]);
    }
    return true;
}

/// Assimp makes up a name where the file gives none.
std::string material_name(const aiScene& scene, const aiMesh& mesh) {
    if (mesh.mMaterialIndex >= scene.mNumMaterials) return {};
    const std::string name = scene.mMaterials[mesh.mMaterialIndex]->GetName().C_Str();
    return name == AI_DEFAULT_MATERIAL_NAME ? std::string{} : name;
}

MeshPart& part_of(const std::string& material, std::vector<MeshPart>& parts) {
    for (auto& part : parts) {
        if (part.material == material) return part;
    }
    return parts.emplace_back(MeshPart{material, {}});
}

}  // namespace

std::vector<MeshPart> load_mesh_parts(const std::filesystem::path& file, const glm::dvec3& scale) {
    Assimp::Importer importer;
    const aiScene& scene = read(importer, file);
    std::vector<MeshPart> parts;
    for (const aiMesh* mesh : meshes_of(scene)) {
        if (!append(*mesh, scale, part_of(material_name(scene, *mesh), parts).mesh)) {
            throw LoadError({file.string() + ": has a vertex that is not finite once scaled"});
        }
    }
    std::erase_if(parts, [](const MeshPart& part) { return part.mesh.triangles.empty(); });
    if (parts.empty()) throw LoadError({file.string() + ": holds no triangles"});
    return parts;
}

Mesh load_mesh(const std::filesystem::path& file, const glm::dvec3& scale) {
    Mesh whole;
    for (const auto& part : load_mesh_parts(file, scale)) {
        const auto first = static_cast<glm::uint>(whole.vertices_m.size());
        whole.vertices_m.insert(whole.vertices_m.end(), part.mesh.vertices_m.begin(),
                                part.mesh.vertices_m.end());
        for (const auto& triangle : part.mesh.triangles) {
            whole.triangles.push_back(triangle + first);
        }
    }
    return whole;
}

}  // namespace scipd::sim
