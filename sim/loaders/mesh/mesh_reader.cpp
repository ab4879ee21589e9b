// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh/mesh_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <new>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/mesh/mesh_folder.h"
#include "sim/loaders/mesh/mesh_material.h"
#include "sim/loaders/mesh/mesh_relief.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

/// Positions and faces are all that a range needs; without the rest more vertices are identical and
/// can be shared.
constexpr int unwanted_components = aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                    aiComponent_COLORS | aiComponent_TEXCOORDS |
                                    aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
                                    aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS;

constexpr unsigned int steps = aiProcess_Triangulate | aiProcess_RemoveComponent;

constexpr std::size_t most_names_told = 10;
constexpr std::uintmax_t largest_mesh_read = 1ULL << 30;

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

/// Any number of nodes can show the same mesh, so a small file can have any number of triangles.
void check_triangle_count(const aiScene& scene, const MeshLimits& limits) {
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
        if (count > limits.triangles) {
            throw std::runtime_error("has more than " + std::to_string(limits.triangles) +
                                     " triangles");
        }
    }
}

/// The library compares each with each, and takes minutes for a hundred thousand.
void check_material_count(const aiScene& scene) {
    constexpr unsigned most_materials = 10'000;
    if (scene.mNumMaterials > most_materials) {
        throw std::runtime_error("has more than " + std::to_string(most_materials) +
                                 " materials; let parts that look alike share one");
    }
}

bool is_finite(const aiMesh* mesh) {
    return std::ranges::all_of(std::span{mesh->mVertices, mesh->mNumVertices},
                               [](const aiVector3D& v) { return std::isfinite(v.x + v.y + v.z); });
}

[[noreturn]] void refuse_mesh(const Assimp::Importer& importer) {
    const std::string reason = importer.GetErrorString();
    if (reason.find("bad_alloc") != reason.npos) throw std::bad_alloc();
    const auto& folder = dynamic_cast<const MeshFolder&>(*importer.GetIOHandler());
    throw std::runtime_error("cannot be read as a mesh: " + printable(reason, whole_path) +
                             (folder.refusal().empty() ? "" : "; it " + folder.refusal()));
}

/// How one file is to be read.
struct Instructions {
    const std::filesystem::path& file;
    MeshAxes axes;
    const MeshLimits& limits;
    MeshContents contents;
};

/// The importer takes ownership of the result.
MeshFolder* folder_of(const Instructions& how) {
    auto folder = std::make_unique<MeshFolder>(how.file);
    if (how.contents == MeshContents::relieved) {
        folder->relieve(
            relieved(how.file, read_file(how.file, largest_mesh_read, "a mesh is wanted here")));
    }
    return folder.release();
}

/// Reads a file and checks it.
const aiScene& read(Assimp::Importer& importer, const Instructions& how) {
    importer.SetIOHandler(folder_of(how));
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, unwanted_components);
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION,
                             how.axes == MeshAxes::as_in_file);
    const aiScene* scene = importer.ReadFile(how.file.string(), 0);
    if (scene == nullptr) refuse_mesh(importer);
    // Done before the validation, which would refuse the file for what does not matter here, such
    // as two cameras of one name, or a texture.
    keep_what_matters(*scene, how.file);
    importer.ApplyPostProcessing(aiProcess_RemoveComponent);
    scene = importer.ApplyPostProcessing(aiProcess_ValidateDataStructure);
    if (scene == nullptr) refuse_mesh(importer);
    check_triangle_count(*scene, how.limits);
    check_material_count(*scene);
    scene = importer.ApplyPostProcessing(steps | aiProcess_SortByPType);
    if (scene == nullptr) refuse_mesh(importer);
    if (!std::ranges::all_of(meshes_of(*scene), is_finite)) {
        throw std::runtime_error("has a vertex that is not finite");
    }
    // Last, since this step takes a NaN as identical to any vertex and would hide it.
    scene = importer.ApplyPostProcessing(aiProcess_JoinIdenticalVertices);
    if (scene == nullptr) refuse_mesh(importer);
    return *scene;
}

/// Whether y is up in what Assimp returns. It turns COLLADA so, unless it is told to leave the
/// axes, and glTF is so by its specification.
bool is_y_up(const std::filesystem::path& file, MeshAxes axes) {
    const std::string extension = extension_of(file);
    return axes == MeshAxes::z_up &&
           (extension == ".dae" || extension == ".gltf" || extension == ".glb");
}

glm::dmat4 matrix_of(const aiMatrix4x4& m) {
    return {m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2,
            m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4};
}

/// Assimp's own step for this takes a transform near the identity for the identity: a scale of
/// 1.009, a turn of half a degree and a move of 9 mm are lost.
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

/// The part of the mesh's material, which is added if there is none yet.
MeshPart& part_of(const aiScene& scene, const aiMesh& mesh, std::vector<MeshPart>& parts) {
    MeshPart wanted;
    if (mesh.mMaterialIndex < scene.mNumMaterials) {
        const aiMaterial& material = *scene.mMaterials[mesh.mMaterialIndex];
        wanted.material = name_of(material);
        wanted.appearance = appearance_of(material);
    }
    const auto known = std::ranges::find_if(parts, [&](const MeshPart& part) {
        return part.material == wanted.material && part.appearance == wanted.appearance;
    });
    return known != parts.end() ? *known : parts.emplace_back(std::move(wanted));
}

void drop_empty(std::vector<MeshPart>& parts) {
    std::erase_if(parts, [](const MeshPart& part) { return part.mesh.triangles.empty(); });
}

/// What the name of a submesh may mean. The meaning in Gazebo comes first. Without a name:
/// everything.
enum class Named {
    /// A node without those of its inner nodes that have names of their own. gz-common 5 and Gazebo
    /// Classic name submeshes so (ColladaLoader.cc, AssimpLoader.cc).
    node,
    mesh,
    node_with_all,
    everything,
};

/// Walks the nodes of a file and collects the meshes that a name means.
class Picker {
  public:
    Picker(const aiScene& scene, std::string name) : scene_(scene), name_(std::move(name)) {}

    std::vector<MeshPart> pick(Named named, const glm::dmat4& here_from_file = glm::dmat4{1.0}) {
        parts_.clear();
        named_ = named;
        walk(*scene_.mRootNode, here_from_file, named == Named::everything);
        drop_empty(parts_);
        return std::move(parts_);
    }

    [[nodiscard]] std::string names() const {
        std::string text;
        std::size_t told = 0;
        for (const auto& name : names_) {
            if (told++ == most_names_told) return text + ", ...";
            text += (text.empty() ? "" : ", ") + quote(name, whole_path);
        }
        return text.empty() ? "none" : text;
    }

  private:
    void walk(const aiNode& node, const glm::dmat4& here_from_parent, bool inside) {
        const glm::dmat4 here_from_node = here_from_parent * matrix_of(node.mTransformation);
        if (is_wanted(node.mName)) {
            inside = true;
        } else if (named_ == Named::node && !is_made_up(node.mName)) {
            inside = false;
        }
        for (const unsigned index : std::span{node.mMeshes, node.mNumMeshes}) {
            const aiMesh& mesh = *scene_.mMeshes[index];
            const bool is_named = is_wanted(mesh.mName);
            if (named_ == Named::mesh ? is_named : inside) add(mesh, here_from_node);
        }
        for (const aiNode* child : std::span{node.mChildren, node.mNumChildren})
            walk(*child, here_from_node, inside);
    }

    /// Whether Assimp made up the name.
    [[nodiscard]] static bool is_made_up(const aiString& name) {
        return std::string_view{name.C_Str()}.starts_with("$ColladaAutoName$");
    }

    bool is_wanted(const aiString& name) {
        if (name.length > 0 && !is_made_up(name)) names_.insert(name.C_Str());
        return name_ == name.C_Str();
    }

    void add(const aiMesh& mesh, const glm::dmat4& here_from_node) {
        append(mesh, here_from_node, part_of(scene_, mesh, parts_).mesh);
    }

    const aiScene& scene_;
    std::string name_;
    Named named_ = Named::node;
    std::set<std::string> names_;
    std::vector<MeshPart> parts_;
};

}  // namespace

std::vector<MeshPart> read_mesh(const std::filesystem::path& file, MeshAxes axes,
                                const MeshLimits& limits, MeshContents contents) {
    Assimp::Importer importer;
    const aiScene& scene = read(importer, {file, axes, limits, contents});
    constexpr glm::dmat4 z_up_from_y_up{1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1};
    const auto axes_of_file = is_y_up(file, axes) ? z_up_from_y_up : glm::dmat4{1.0};
    auto parts = Picker{scene, {}}.pick(Named::everything, axes_of_file);
    if (parts.empty()) throw std::runtime_error("holds no triangles");
    return parts;
}

std::vector<MeshPart> read_submesh(const std::filesystem::path& file, const std::string& name,
                                   const MeshLimits& limits, MeshContents contents) {
    std::string names;
    // In COLLADA, Gazebo goes by names. If a mesh has no names, a world may go by its ids.
    for (const bool by_name : {true, false}) {
        Assimp::Importer importer;
        importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, by_name);
        const aiScene& scene = read(importer, {file, MeshAxes::as_in_file, limits, contents});
        Picker picker{scene, name};
        for (const Named named : {Named::node, Named::mesh, Named::node_with_all}) {
            if (auto parts = picker.pick(named); !parts.empty()) return parts;
        }
        if (by_name) names = picker.names();
        if (extension_of(file) != ".dae") break;
    }
    throw std::runtime_error("has no submesh " + quote(name, whole_path) + "; there are " + names);
}

}  // namespace scipd::sim
