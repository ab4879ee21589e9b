// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh/mesh_shelf.h"

#include <algorithm>
#include <deque>
#include <set>
#include <thread>
#include <utility>

namespace scipd::sim {
namespace {

MeshReading begin_reading(const MeshSource& source, const MeshLimits& limits) {
    return {source.file, source.submesh, MeshAxes::as_in_file, limits};
}

/// At a time; each may take as much memory as one may.
std::size_t most_readings() {
    return std::clamp(std::thread::hardware_concurrency(), 1U, 8U);
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
    const auto take_up_first = [&] {
        triangles += std::visit([this](auto& first) { return take_up(first); }, running.front());
        running.pop_front();
    };
    for (auto& batch : batches_of({once.begin(), once.end()})) {
        if (running.size() == most_readings()) take_up_first();
        if (triangles > most_triangles_) break;  // which is told where they are shown
        if (batch.size() > 1) {
            running.emplace_back(std::in_place_type<MeshBatch>, std::move(batch), of_each_);
        } else {
            running.emplace_back(Alone{batch.front(), begin_reading(batch.front(), of_each_)});
        }
    }
    while (!running.empty())
        take_up_first();
}

std::size_t MeshShelf::take_up(MeshBatch& batch) {
    auto outcome = batch.outcome();
    std::size_t triangles = 0;
    for (std::size_t i = 0; i < batch.sources().size(); ++i) {
        const MeshSource& source = batch.sources()[i];
        if (outcome) {
            triangles += triangles_of(in_file_[source] = std::move((*outcome)[i]));
        } else {
            Alone alone{source, begin_reading(source, of_each_)};
            triangles += take_up(alone);
        }
    }
    return triangles;
}

std::size_t MeshShelf::take_up(Alone& alone) {
    return triangles_of(in_file_[alone.source] = outcome_of(alone.reading));
}

const std::vector<MeshPart>& MeshShelf::in_file(const MeshSource& source) {
    auto known = in_file_.find(source);
    if (known == in_file_.end()) {
        MeshReading reading = begin_reading(source, of_each_);
        known = in_file_.emplace(source, outcome_of(reading)).first;
    }
    if (const auto* error = std::get_if<LoadError>(&known->second)) throw *error;
    return std::get<std::vector<MeshPart>>(known->second);
}

const std::vector<SharedPart>& MeshShelf::parts_of(const std::filesystem::path& file,
                                                   const sdf::Mesh& mesh) {
    const MeshSource source{file, mesh.Submesh()};
    const glm::dvec3 scale{mesh.Scale().X(), mesh.Scale().Y(), mesh.Scale().Z()};
    const Key key{source, scale.x, scale.y, scale.z, mesh.CenterSubmesh()};
    if (const auto known = parts_.find(key); known != parts_.end()) return known->second;
    auto placed = in_file(source);
    place(placed, !source.submesh.empty() && mesh.CenterSubmesh(), scale, file);
    std::vector<SharedPart> parts;
    for (auto& part : placed) {
        parts.push_back({part.material, std::make_shared<const Mesh>(std::move(part.mesh))});
        count(parts.back().mesh);
    }
    return parts_.emplace(key, std::move(parts)).first->second;
}

void MeshShelf::count(const Shape& shape) {
    // Round things matter only where they are large.
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
