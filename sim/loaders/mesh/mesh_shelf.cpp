// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh/mesh_shelf.h"

#include <algorithm>
#include <deque>
#include <set>
#include <thread>
#include <utility>

#include "sim/loaders/file/doing.h"

namespace scipd::sim {
namespace {

MeshReading begin_reading(const MeshSource& source, const MeshLimits& limits) {
    return {source.file, source.submesh, MeshAxes::as_in_file, limits};
}

/// How many children read at one time.
std::size_t most_readings() {
    return std::clamp(std::thread::hardware_concurrency(), 1U, 8U);
}

/// The limits of a batch. Small files hardly need more; if they do, each is read alone.
MeshLimits share_of(MeshLimits limits) {
    limits.memory_bytes /= most_readings();
    return limits;
}

void tell_reading(const std::filesystem::path& file) {
    now_doing("reading " + file.string());
}

using InFile = std::variant<std::vector<MeshPart>, LoadError>;

InFile outcome_of(MeshReading& reading) {
    try {
        return reading.parts();
    } catch (const LoadError& error) {
        return error;
    }
}

std::size_t triangles_of(const InFile& outcome) {
    std::size_t count = 0;
    if (const auto* parts = std::get_if<std::vector<MeshPart>>(&outcome)) {
        for (const MeshPart& part : *parts)
            count += part.mesh.triangles.size();
    }
    return count;
}

}  // namespace

void MeshShelf::read_ahead(const std::vector<MeshSource>& sources) {
    const std::set<MeshSource> once{sources.begin(), sources.end()};
    std::deque<Running> running;
    std::size_t triangles = 0;
    std::size_t memory_bytes = 0;
    const auto take_up_first = [&] {
        Running& first = running.front();
        triangles += std::visit([this](auto& reading) { return take_up(reading); }, first.reading);
        memory_bytes -= first.memory_bytes;
        running.pop_front();
    };
    for (auto& batch : batches_of({once.begin(), once.end()})) {
        const MeshLimits limits = batch.size() > 1 ? share_of(limits_) : limits_;
        const std::size_t wanted_bytes = memory_for(batch, limits);
        while (!running.empty() && (running.size() == most_readings() ||
                                    memory_bytes + wanted_bytes > limits_.memory_bytes)) {
            take_up_first();
        }
        if (triangles > most_triangles_) break;  // count() will report it
        memory_bytes += wanted_bytes;
        if (batch.size() > 1) {
            running.push_back({MeshBatch{std::move(batch), limits}, wanted_bytes});
        } else {
            running.push_back(
                {Alone{batch.front(), begin_reading(batch.front(), limits)}, wanted_bytes});
        }
    }
    while (!running.empty())
        take_up_first();
}

std::size_t MeshShelf::take_up(MeshBatch& batch) {
    tell_reading(batch.sources().front().file);
    auto outcome = batch.outcome();
    if (!outcome) return 0;
    std::size_t triangles = 0;
    for (std::size_t i = 0; i < batch.sources().size(); ++i)
        triangles += triangles_of(in_file_[batch.sources()[i]] = std::move((*outcome)[i]));
    return triangles;
}

std::size_t MeshShelf::take_up(Alone& alone) {
    tell_reading(alone.source.file);
    return triangles_of(in_file_[alone.source] = outcome_of(alone.reading));
}

const std::vector<MeshPart>& MeshShelf::in_file(const MeshSource& source) {
    auto known = in_file_.find(source);
    if (known == in_file_.end()) {
        tell_reading(source.file);
        MeshReading reading = begin_reading(source, limits_);
        known = in_file_.emplace(source, outcome_of(reading)).first;
    }
    if (const auto* error = std::get_if<LoadError>(&known->second)) throw *error;
    return std::get<std::vector<MeshPart>>(known->second);
}

const std::vector<SharedPart>& MeshShelf::parts_of(const std::filesystem::path& file,
                                                   const MeshView& view) {
    const MeshSource source{file, view.submesh};
    const glm::dvec3& scale = view.scale;
    const Key key{source, scale.x, scale.y, scale.z, view.is_centred};
    if (const auto known = parts_.find(key); known != parts_.end()) return known->second;
    auto placed = in_file(source);
    place(placed, !source.submesh.empty() && view.is_centred, scale, file);
    std::vector<SharedPart> parts;
    for (auto& part : placed) {
        parts.push_back(
            {part.material, std::make_shared<const Mesh>(std::move(part.mesh)), part.appearance});
        count(parts.back().mesh);
    }
    return parts_.emplace(key, std::move(parts)).first->second;
}

const SharedMesh& MeshShelf::stand_in(const std::function<Mesh()>& make) {
    if (stand_in_ == nullptr) {
        auto made = std::make_shared<const Mesh>(make());
        count(made);
        stand_in_ = std::move(made);
    }
    return stand_in_;
}

void MeshShelf::count(const Shape& shape) {
    // Other shapes, and spheres of less than this radius, have few triangles.
    const auto* mesh = std::get_if<SharedMesh>(&shape);
    const auto* sphere = std::get_if<Sphere>(&shape);
    if (mesh != nullptr) triangles_ += (*mesh)->triangles.size();
    if (sphere != nullptr && sphere->radius_m > 1.0) {
        triangles_ += tessellate(shape).triangles.size();
    }
    if (triangles_ <= most_triangles_) return;
    throw LoadError({"with this one the world has more than " + std::to_string(most_triangles_) +
                     " triangles; world_triangles under limits in the configuration allows more"});
}

}  // namespace scipd::sim
