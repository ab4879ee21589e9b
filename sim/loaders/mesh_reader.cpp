// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>
#include <span>
#include <stdexcept>
#include <string>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

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
                               aiProcess_PreTransformVertices | aiProcess_SortByPType;

std::span<aiMesh* const> meshes_of(const aiScene& scene) {
    return {scene.mMeshes, scene.mNumMeshes};
}

/// A polygon of n corners becomes n - 2 triangles.
std::uint64_t triangle_count(const aiMesh& mesh) {
    std::uint64_t count = 0;
    for (const aiFace& face : std::span{mesh.mFaces, mesh.mNumFaces})
        count += std::max(face.mNumIndices, 2U) - 2;
    return count;
}

/// A node shows any mesh again, and so a small file can stand for any number of triangles.
void check_triangle_count(const aiScene& scene) {
    std::vector<std::uint64_t> of_mesh;
    for (const aiMesh* mesh : meshes_of(scene))
        of_mesh.push_back(triangle_count(*mesh));
    std::uint64_t count = 0;
    std::vector<const aiNode*> nodes{scene.mRootNode};
    while (!nodes.empty()) {
        const aiNode& node = *nodes.back();
        nodes.pop_back();
        nodes.insert(nodes.end(), node.mChildren, node.mChildren + node.mNumChildren);
        for (const unsigned mesh : std::span{node.mMeshes, node.mNumMeshes})
            count += of_mesh.at(mesh);
        if (count > most_mesh_triangles) {
            throw std::runtime_error("has more than 10 million triangles");
        }
    }
}

bool is_finite(const aiMesh* mesh) {
    return std::ranges::all_of(std::span{mesh->mVertices, mesh->mNumVertices},
                               [](const aiVector3D& v) { return std::isfinite(v.x + v.y + v.z); });
}

[[noreturn]] void refuse(const Assimp::Importer& importer) {
    const std::string reason = importer.GetErrorString();
    if (reason.find("bad_alloc") != reason.npos) throw std::bad_alloc();
    throw std::runtime_error("cannot be read as a mesh: " + printable(reason));
}

const aiScene& read(Assimp::Importer& importer, const std::filesystem::path& file, MeshAxes axes) {
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, unwanted);
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION,
                             axes == MeshAxes::as_in_file);
    const aiScene* scene = importer.ReadFile(file.string(), aiProcess_ValidateDataStructure);
    if (scene == nullptr) refuse(importer);
    check_triangle_count(*scene);
    scene = importer.ApplyPostProcessing(steps);
    if (scene == nullptr) refuse(importer);
    if (!std::ranges::all_of(meshes_of(*scene), is_finite)) {
        throw std::runtime_error("has a vertex that is not finite");
    }
    // Last, since it takes a NaN for identical to any vertex and would hide it.
    scene = importer.ApplyPostProcessing(aiProcess_JoinIdenticalVertices);
    if (scene == nullptr) refuse(importer);
    return *scene;
}

/// Whether Assimp hands y up: it does so itself with COLLADA, unless it is told to leave the axes,
/// and glTF has it by its specification.
bool is_y_up(const std::filesystem::path& file, MeshAxes axes) {
    const std::string extension = extension_of(file);
    return axes == MeshAxes::z_up &&
           (extension == ".dae" || extension == ".gltf" || extension == ".glb");
}

void append(const aiMesh& from, bool y_up, Mesh& to) {
    const auto first = static_cast<glm::uint>(to.vertices_m.size());
    for (const aiVector3D& v : std::span{from.mVertices, from.mNumVertices})
        to.vertices_m.push_back(y_up ? glm::vec3{v.x, -v.z, v.y} : glm::vec3{v.x, v.y, v.z});
    for (const aiFace& face : std::span{from.mFaces, from.mNumFaces}) {
        if (face.mNumIndices != 3) continue;
        const std::span corner{face.mIndices, 3};
        to.triangles.emplace_back(first + corner[0], first + corner[1], first + corner[2]);
    }
}

/// Assimp makes up a name where the file gives none.
std::string material_name(const aiScene& scene, const aiMesh& mesh) {
    if (mesh.mMaterialIndex >= scene.mNumMaterials) return {};
    const std::string name = scene.mMaterials[mesh.mMaterialIndex]->GetName().C_Str();
    return name == AI_DEFAULT_MATERIAL_NAME ? std::string{} : name;
}

MeshPart& part_of(const std::string& material, std::vector<MeshPart>& parts) {
    const auto known = std::ranges::find(parts, material, &MeshPart::material);
    return known != parts.end() ? *known : parts.emplace_back(MeshPart{material, {}});
}

}  // namespace

std::vector<MeshPart> read_mesh(const std::filesystem::path& file, MeshAxes axes) {
    Assimp::Importer importer;
    const aiScene& scene = read(importer, file, axes);
    const bool y_up = is_y_up(file, axes);
    std::vector<MeshPart> parts;
    for (const aiMesh* mesh : meshes_of(scene))
        append(*mesh, y_up, part_of(material_name(scene, *mesh), parts).mesh);
    std::erase_if(parts, [](const MeshPart& part) { return part.mesh.triangles.empty(); });
    if (parts.empty()) throw std::runtime_error("holds no triangles");
    return parts;
}

}  // namespace scipd::sim
