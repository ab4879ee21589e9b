// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <type_traits>

#include "sim/loaders/confined.h"
#include "sim/loaders/load_error.h"
#include "sim/loaders/mesh_reader.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_file = 1ULL << 30;
/// Assimp takes up to 600 bytes and 2 us a triangle (load_bench): the largest mesh that is taken
/// fits into either.
constexpr Confines confines{.processor_time = std::chrono::seconds{60}, .memory_bytes = 8ULL << 30};

// From the child to us: the two are one program, and no byte of the file is in between.

template <typename Value>
void put(const Value* values, std::size_t count, std::FILE* out) {
    static_assert(std::is_trivially_copyable_v<Value>);
    if (std::fwrite(values, sizeof(Value), count, out) != count) throw std::bad_alloc();
}

template <typename Container>
void put_all(const Container& values, std::FILE* out) {
    const std::uint64_t count = values.size();
    put(&count, 1, out);
    put(values.data(), values.size(), out);
}

template <typename Container>
void take_all(Container& values, std::FILE* in) {
    std::uint64_t count = 0;
    const bool is_told = std::fread(&count, sizeof count, 1, in) == 1;
    values.resize(count);
    const auto size = sizeof(typename Container::value_type);
    if (!is_told || std::fread(values.data(), size, count, in) != count) {
        throw std::runtime_error("was read but did not arrive");
    }
}

void put_parts(const std::vector<MeshPart>& parts, std::FILE* out) {
    const std::uint64_t count = parts.size();
    put(&count, 1, out);
    for (const MeshPart& part : parts) {
        put_all(part.material, out);
        put_all(part.mesh.vertices_m, out);
        put_all(part.mesh.triangles, out);
    }
}

std::vector<MeshPart> take_parts(std::FILE* in) {
    std::uint64_t count = 0;
    if (std::fread(&count, sizeof count, 1, in) != 1) throw std::runtime_error("did not arrive");
    std::vector<MeshPart> parts(count);
    for (MeshPart& part : parts) {
        take_all(part.material, in);
        take_all(part.mesh.vertices_m, in);
        take_all(part.mesh.triangles, in);
    }
    return parts;
}

std::string known_kinds() {
    std::string text;
    for (const auto extension : mesh_extensions)
        text += (text.empty() ? "" : ", ") + std::string(extension);
    return text;
}

void check_file(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
        throw std::runtime_error("no such file; a mesh is wanted here");
    }
    if (!is_mesh_file(file)) {
        throw std::runtime_error("is no kind of mesh that is known; name one of " + known_kinds());
    }
    if (const auto size = fs::file_size(file, error); error || size > largest_file) {
        throw std::runtime_error("is larger than 1 GiB");
    }
}

void apply(const glm::dvec3& scale, Mesh& mesh) {
    for (glm::vec3& vertex : mesh.vertices_m) {
        vertex = glm::vec3{glm::dvec3{vertex} * scale};
        if (!std::isfinite(vertex.x + vertex.y + vertex.z)) {
            throw std::runtime_error("has a vertex that is not finite once scaled");
        }
    }
}

}  // namespace

std::string extension_of(const fs::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

bool is_mesh_file(const fs::path& file) {
    return std::ranges::find(mesh_extensions, extension_of(file)) != mesh_extensions.end();
}

std::vector<MeshPart> load_mesh_parts(const fs::path& file, const glm::dvec3& scale,
                                      MeshAxes axes) {
    try {
        check_file(file);
        const auto read = [&](std::FILE* out) { put_parts(read_mesh(file, axes), out); };
        std::vector<MeshPart> parts = take_parts(run_confined(confines, read).get());
        for (MeshPart& part : parts)
            apply(scale, part.mesh);
        return parts;
    } catch (const std::runtime_error& wrong) {
        throw LoadError({file.string() + ": " + wrong.what()});
    }
}

Mesh load_mesh(const fs::path& file, const glm::dvec3& scale) {
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
