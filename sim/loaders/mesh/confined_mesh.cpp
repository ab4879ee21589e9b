// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh/confined_mesh.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/loaders/file/between_processes.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/mistaken_file.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/mesh/mesh_reader.h"
#include "sim/loaders/mesh/mesh_relief.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_mesh_file = 1ULL << 30;
constexpr auto more_memory = "world_memory_mb under limits in the configuration allows more";

void put_part(const MeshPart& part, std::FILE* out) {
    put_all(part.material, out);
    put(part.appearance, out);
    put_all(part.mesh.vertices_m, out);
    put_all(part.mesh.triangles, out);
}

MeshPart take_part(std::FILE* in) {
    MeshPart part;
    part.material = take_all<std::string>(in);
    part.appearance = take<Appearance>(in);
    part.mesh.vertices_m = take_all<std::vector<glm::vec3>>(in);
    part.mesh.triangles = take_all<std::vector<glm::uvec3>>(in);
    return part;
}

/// Limits that a sound file of this size stays far below. A few damaged bytes on which the library
/// runs in circles then do not take a minute and all memory. Assimp takes up to 2 us a triangle
/// (load_bench), and a triangle has at least 12 bytes.
Confines confines_of(const fs::path& file, std::uintmax_t size, const MeshLimits& limits) {
    constexpr std::chrono::seconds most_time{60};
    constexpr std::uintmax_t little_memory = 1ULL << 30;
    Confines confines{.processor_time = most_time,
                      .memory_bytes = limits.memory_bytes,
                      .wall_time = limits.wall_time,
                      .more_memory = more_memory};
    // Its data may lie in other files, so its own size tells nothing.
    if (extension_of(file) == ".gltf") return confines;
    const std::chrono::seconds time{5 + size / 4'000'000};
    const auto memory_bytes = static_cast<std::size_t>(little_memory + 100 * size);
    confines.processor_time = std::min(most_time, time);
    if (memory_bytes < limits.memory_bytes) {
        confines.memory_bytes = memory_bytes;
        confines.more_memory.clear();  // no setting does
    }
    return confines;
}

/// The size in bytes. Throws std::runtime_error if the file cannot be a mesh.
std::uintmax_t check_file(const fs::path& file) {
    if (const auto plain = check_plain_file(file); !plain) {
        throw std::runtime_error(plain.error().why + "; a mesh is wanted here");
    }
    if (!is_mesh_file(file)) {
        throw std::runtime_error("is no kind of mesh that is known; name one of " +
                                 listed(mesh_extensions));
    }
    std::error_code error;
    const auto size = fs::file_size(file, error);
    if (error || size > largest_mesh_file) throw std::runtime_error("is larger than 1 GiB");
    if (const auto why = why_mistaken(beginning_of(file), "mesh"); !why.empty()) {
        throw std::runtime_error(why);
    }
    return size;
}

/// Limits for one child that reads all of these: those of a file of their total size.
Confines confines_of(const std::vector<MeshSource>& sources, const MeshLimits& limits) {
    std::uintmax_t size = 0;
    for (const MeshSource& source : sources)
        size += check_file(source.file);
    return confines_of(sources.front().file, size, limits);
}

std::vector<MeshPart> read(const MeshSource& source, MeshAxes axes, const MeshLimits& limits,
                           MeshContents contents) {
    return source.submesh.empty() ? read_mesh(source.file, axes, limits, contents)
                                  : read_submesh(source.file, source.submesh, limits, contents);
}

bool goes_alone(const fs::path& file) {
    return extension_of(file) == ".gltf" || !check_plain_file(file);
}

}  // namespace

std::vector<std::vector<MeshSource>> batches_of(const std::vector<MeshSource>& sources) {
    // Small batches keep several children busy, and little is read again if one fails.
    constexpr std::uintmax_t most_bytes = 8'000'000;
    std::vector<std::vector<MeshSource>> batches;
    std::uintmax_t bytes = most_bytes;  // of the last batch
    for (const MeshSource& source : sources) {
        std::error_code error;
        const auto size = goes_alone(source.file) ? most_bytes : fs::file_size(source.file, error);
        if (error || bytes + size > most_bytes) {
            batches.emplace_back();
            bytes = 0;
        }
        batches.back().push_back(source);
        bytes += error ? most_bytes : size;
    }
    return batches;
}

std::size_t memory_for(const std::vector<MeshSource>& sources, const MeshLimits& limits) {
    try {
        return confines_of(sources, limits).memory_bytes;
    } catch (const std::runtime_error&) {
        return 0;  // MeshBatch starts no child
    }
}

MeshBatch::MeshBatch(std::vector<MeshSource> sources, const MeshLimits& of_each)
    : sources_(std::move(sources)) {
    try {
        const auto work = [&](std::FILE* out) {
            for (const MeshSource& source : sources_) {
                put_each(read(source, MeshAxes::as_in_file, of_each, MeshContents::all), out,
                         put_part);
            }
        };
        child_ = std::make_unique<Confined>(confines_of(sources_, of_each), work);
    } catch (const std::runtime_error&) {
        // outcome() returns nothing then.
    }
}

std::optional<std::vector<std::vector<MeshPart>>> MeshBatch::outcome() {
    if (!child_) return std::nullopt;
    try {
        const File answer = child_->outcome();
        std::vector<std::vector<MeshPart>> parts;
        for (std::size_t i = 0; i < sources_.size(); ++i)
            parts.push_back(take_each<std::vector<MeshPart>>(answer.get(), take_part));
        return parts;
    } catch (const std::runtime_error&) {
        return std::nullopt;
    }
}

MeshReading::MeshReading(fs::path file, std::string submesh, MeshAxes axes,
                         const MeshLimits& limits)
    : file_(std::move(file)), submesh_(std::move(submesh)), axes_(axes), limits_(limits) {
    begin(MeshContents::all);
}

void MeshReading::begin(MeshContents contents) {
    try {
        const Confines confines = confines_of(file_, check_file(file_), limits_);
        const auto work = [&](std::FILE* out) {
            put_each(read({file_, submesh_}, axes_, limits_, contents), out, put_part);
        };
        child_ = std::make_unique<Confined>(confines, work);
    } catch (const std::runtime_error& wrong) {
        why_not_ = wrong.what();
    }
}

std::vector<MeshPart> MeshReading::outcome() {
    if (!child_) throw std::runtime_error(why_not_);
    return take_each<std::vector<MeshPart>>(child_->outcome().get(), take_part);
}

std::vector<MeshPart> MeshReading::parts() {
    try {
        try {
            return outcome();
        } catch (const std::runtime_error&) {
            const bool is_slow = std::chrono::steady_clock::now() - begun_ > limits_.wall_time / 2;
            if (is_slow || !child_ || !can_be_relieved(file_)) throw;
        }
        begin(MeshContents::relieved);
        return outcome();
    } catch (const std::runtime_error& wrong) {
        throw LoadError({file_.string() + ": " + wrong.what()});
    }
}

}  // namespace scipd::sim
