// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh/mesh_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <assimp/DefaultIOStream.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <glm/mat4x4.hpp>

#include "sim/expected.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/file/xml_text.h"
#include "sim/loaders/mesh/mesh_nodes.h"
#include "sim/loaders/mesh/mesh_relief.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

/// Limits what Assimp may open while it reads a mesh: the mesh, and plain files in its folder and
/// in the folders below. A mesh can name anything, such as a device, a FIFO that nobody writes to
/// or the files of another user, and the library would open it.
class MeshFolder final : public Assimp::DefaultIOSystem {
  public:
    explicit MeshFolder(const std::filesystem::path& mesh);

    /// Gives Assimp these contents in place of the mesh's own, and lets it open no file that only
    /// tells how the mesh looks (.mtl).
    void relieve(std::string contents) { relieved_ = std::move(contents); }

    bool Exists(const char* file) const override;
    /// Returns null if the file may not be opened; no file may be opened for writing.
    Assimp::IOStream* Open(const char* file, const char* mode) override;

    /// The reason for which Assimp was refused its first file; empty if it got all.
    [[nodiscard]] const std::string& refusal() const { return refusal_; }

  private:
    /// The error says why the file may not be opened.
    [[nodiscard]] Expected<> check(const std::filesystem::path& file) const;

    std::filesystem::path mesh_;
    std::optional<std::string> relieved_;
    /// The folder of the mesh as it is named, and that of the file to which its name links: some
    /// installations link file by file.
    std::vector<std::filesystem::path> folders_;
    std::string refusal_;
};

/// Assimp's own stream, over a file that is open already.
class Stream final : public Assimp::DefaultIOStream {
  public:
    Stream(File file, const std::string& name) : DefaultIOStream(file.release(), name) {}
};

Stream* stream_of(const std::string& contents) {
    File file = memory_file();
    std::fwrite(contents.data(), 1, contents.size(), file.get());
    std::rewind(file.get());
    // The stream asks for its size by this name.
    const std::string name = "/proc/self/fd/" + std::to_string(fileno(file.get()));
    return new Stream(std::move(file), name);
}

/// In the folder or below it. Below the root folder would be everything, so there nothing counts.
bool lies_in(const fs::path& file, const fs::path& folder) {
    if (file.parent_path() == folder) return true;
    const auto [end, ignored] =
        std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return folder.has_relative_path() && end == folder.end();
}

MeshFolder::MeshFolder(const fs::path& mesh) : mesh_(mesh) {
    std::error_code error;
    folders_.push_back(fs::canonical(fs::absolute(mesh).parent_path(), error));
    folders_.push_back(fs::canonical(mesh, error).parent_path());
}

Expected<> MeshFolder::check(const fs::path& file) const {
    if (file == mesh_) return {};
    if (relieved_ && file.extension() == ".mtl") return refuse("is not wanted");
    // Resolves links and dots, also where the file is missing: nobody learns what lies elsewhere.
    std::error_code error;
    const fs::path real = fs::weakly_canonical(file, error);
    const bool inside = !error && std::ranges::any_of(folders_, [&](const fs::path& folder) {
        return lies_in(real, folder);
    });
    if (!inside) return refuse("does not lie in the folder of the mesh");
    if (!fs::exists(real, error)) return refuse("is not there");
    return check_plain_file(real);
}

bool MeshFolder::Exists(const char* file) const {
    return check(file).has_value();
}

Assimp::IOStream* MeshFolder::Open(const char* file, const char* mode) {
    std::string why;
    try {
        const auto allowed = mode[0] == 'r' ? check(file) : refuse("is only read");
        if (allowed && relieved_ && file == mesh_) return stream_of(*relieved_);
        if (allowed) return new Stream(open_file(file), file);
        why = allowed.error().why;
    } catch (const std::runtime_error& error) {
        why = error.what();
    }
    const fs::path name = fs::path{file}.lexically_relative(mesh_.parent_path());
    if (refusal_.empty()) refusal_ = "names " + quote(name.string(), whole_path) + ", which " + why;
    return nullptr;
}

/// Positions and faces are all that a range needs; without the rest more vertices are identical and
/// can be shared.
constexpr int unwanted_components = aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                    aiComponent_COLORS | aiComponent_TEXCOORDS |
                                    aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
                                    aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS;

constexpr unsigned int steps =
    aiProcess_Triangulate | aiProcess_RemoveComponent | aiProcess_SortByPType;

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

/// Each is compared with each, which takes minutes for a hundred thousand.
void check_material_count(const aiScene& scene) {
    constexpr unsigned most_materials = 10'000;
    if (scene.mNumMaterials > most_materials) {
        throw std::runtime_error("has more than " + std::to_string(most_materials) +
                                 " materials; let parts that look alike share one");
    }
}

/// The validation would say only that a mesh has no faces.
void check_faces(const aiScene& scene) {
    bool has_lines = false;
    for (const aiMesh* mesh : meshes_of(scene)) {
        if (triangle_count(*mesh) > 0) return;
        has_lines |= (mesh->mPrimitiveTypes & aiPrimitiveType_LINE) != 0;
    }
    if (scene.mNumMeshes == 0) return;
    throw std::runtime_error(std::string{"holds "} + (has_lines ? "lines" : "a cloud of points") +
                             " and no faces, and scanners see faces only; make a mesh of it, as "
                             "MeshLab and CloudCompare can");
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
    const bool is_relieved = how.contents == MeshContents::relieved;
    if (is_relieved || extension_of(how.file) == ".dae") {
        std::string bytes = read_file(how.file, largest_mesh_read, "a mesh is wanted here");
        if (is_relieved) {
            folder->relieve(relieved(how.file, bytes));
        } else if (blank_comments(bytes)) {
            folder->relieve(std::move(bytes));
        }
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
    check_faces(*scene);
    // Done before the validation, which would refuse the file for what does not matter here, such
    // as two cameras of one name, or a texture.
    keep_what_matters(*scene, how.file);
    importer.ApplyPostProcessing(aiProcess_RemoveComponent);
    scene = importer.ApplyPostProcessing(aiProcess_ValidateDataStructure);
    if (scene == nullptr) refuse_mesh(importer);
    check_triangle_count(*scene, how.limits);
    check_material_count(*scene);
    scene = importer.ApplyPostProcessing(steps);
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

}  // namespace

std::vector<MeshPart> read_mesh(const std::filesystem::path& file, MeshAxes axes,
                                const MeshLimits& limits, MeshContents contents) {
    Assimp::Importer importer;
    const aiScene& scene = read(importer, {file, axes, limits, contents});
    constexpr glm::dmat4 z_up_from_y_up{1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1};
    auto parts = parts_of(scene, is_y_up(file, axes) ? z_up_from_y_up : glm::dmat4{1.0});
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
        if (auto parts = submesh_of(scene, name); !parts.empty()) return parts;
        if (by_name) names = names_in(scene);
        if (extension_of(file) != ".dae") break;
    }
    throw std::runtime_error("has no submesh " + quote(name, whole_path) + "; there are " + names);
}

}  // namespace scipd::sim
